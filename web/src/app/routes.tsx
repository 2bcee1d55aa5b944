import { Component, lazy, Suspense, useEffect, type ComponentType, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import { MapPage } from "@/features/map/MapPage";
import { liveStore, useLinkLost, whenLinkIsBack } from "@/shared/live";
import { Link, useLocation } from "@/shared/router";
import { Button, PanelEmpty, PanelLoading } from "@/shared/ui";

// Pages other than the map come when they are opened. A feature's page is its index.tsx: default export, props {id?}.
const modules = import.meta.glob<{ default: ComponentType<{ id?: string }> }>("../features/*/index.tsx");

const pages = new Map(
  Object.entries(modules).map(
    ([path, load]) =>
      [
        /features\/([^/]+)\//.exec(path)?.[1] ?? "",
        lazy(() => load().catch((cause: unknown) => Promise.reject(new NotLoaded(path, { cause })))),
      ] as const,
  ),
);

/** Its page's code did not come, which is no fault of the page. */
class NotLoaded extends Error {}

class Boundary extends Component<{ children: ReactNode }, { error?: unknown }> {
  override state: { error?: unknown } = {};
  static getDerivedStateFromError(error: unknown) {
    return { error };
  }
  override render() {
    const { error } = this.state;
    if (error === undefined) return this.props.children;
    return error instanceof NotLoaded ? <CutOff /> : <Crashed />;
  }
}

function Crashed() {
  const { t } = useTranslation();
  return (
    <div className="card">
      <h1 className="sr-only">{t("page.crashed")}</h1>
      <PanelEmpty what={t("page.crashed")} action={<LoadAgain />} />
    </div>
  );
}

/** Loads itself when the link is back. Not before: loading while it is cut would lose the frame, too. */
function CutOff() {
  const { t } = useTranslation();
  useEffect(() => whenLinkIsBack(liveStore, () => window.location.reload()), []);
  if (!useLinkLost()) return <Crashed />;
  return (
    <div className="card" role="status">
      <h1 className="sr-only">{t("page.cut")}</h1>
      <PanelEmpty what={t("page.cut")} when={t("page.comes_back")} />
    </div>
  );
}

function LoadAgain() {
  const { t } = useTranslation();
  return <Button onPress={() => window.location.reload()}>{t("page.reload")}</Button>;
}

/** The page of the address: /map, /send, /vehicles/TP-01 ... */
export function Page() {
  const { t } = useTranslation();
  const { path } = useLocation();
  const [, name = "map", rawId] = path.split("/");
  let id: string | undefined;
  try {
    id = rawId ? decodeURIComponent(rawId) : undefined;
  } catch {
    id = rawId;
  }
  if (name === "map" || name === "") return <MapPage />;
  const Feature = pages.get(name);
  if (Feature === undefined) {
    return (
      <div className="card">
        <h1 className="sr-only">{t("page.not_found")}</h1>
        <PanelEmpty
          what={t("page.not_found")}
          action={
            <Link to="/map" className="btn">
              {t("page.to_map")}
            </Link>
          }
        />
      </div>
    );
  }
  return (
    <Boundary key={name}>
      <Suspense fallback={<PanelLoading what={t(`nav.${name}`)} />}>
        <Feature {...(id !== undefined && { id })} />
      </Suspense>
    </Boundary>
  );
}

import { Component, lazy, Suspense, type ComponentType, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import { MapPage } from "@/features/map/MapPage";
import { Link, useLocation } from "@/shared/router";
import { Button, PanelEmpty, PanelLoading } from "@/shared/ui";

// Pages other than the map come when they are opened. A feature's page is its index.tsx: default export, props {id?}.
const modules = import.meta.glob<{ default: ComponentType<{ id?: string }> }>("../features/*/index.tsx");

const pages = new Map(
  Object.entries(modules).map(
    ([path, load]) => [/features\/([^/]+)\//.exec(path)?.[1] ?? "", lazy(load)] as const,
  ),
);

class Boundary extends Component<
  { words: { failed: string; again: string }; children: ReactNode },
  { failed: boolean }
> {
  override state = { failed: false };
  static getDerivedStateFromError() {
    return { failed: true };
  }
  override render() {
    if (!this.state.failed) return this.props.children;
    return (
      <div className="card">
        <PanelEmpty
          what={this.props.words.failed}
          action={<Button onPress={() => window.location.reload()}>{this.props.words.again}</Button>}
        />
      </div>
    );
  }
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
    <Boundary key={name} words={{ failed: t("page.crashed"), again: t("page.reload") }}>
      <Suspense fallback={<PanelLoading what={t(`nav.${name}`)} />}>
        <Feature {...(id !== undefined && { id })} />
      </Suspense>
    </Boundary>
  );
}

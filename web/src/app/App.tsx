import { useEffect } from "react";
import { useTranslation } from "react-i18next";
import { SignInPage } from "@/features/signin/SignInPage";
import { loadSession, useSessionState } from "@/shared/live/session";
import { navigate, useLocation } from "@/shared/router";
import { PanelFailed, PanelLoading } from "@/shared/ui";
import { Page } from "./routes";
import { Shell } from "./shell/Shell";

const isInside = (path: string) =>
  path.startsWith("/") && !path.startsWith("//") && !path.startsWith("/signin");

/** Signed out: the sign-in page, which leads back to where one was. Signed in: the shell and a page. */
export function App() {
  const { t } = useTranslation();
  const session = useSessionState();
  const { path, query } = useLocation();
  const back = query.get("back") ?? "/map";
  const target =
    session.kind === "signed_out" && path !== "/signin"
      ? `/signin?back=${encodeURIComponent(path === "/" ? "/map" : path + window.location.search)}`
      : session.kind === "signed_in" && path === "/signin"
        ? isInside(back)
          ? back
          : "/map"
        : session.kind === "signed_in" && path === "/"
          ? `/map${window.location.search}`
          : undefined;
  useEffect(() => {
    if (target !== undefined) navigate(target, { replace: true });
  }, [target]);

  switch (session.kind) {
    case "loading":
      return (
        <main className="alone">
          <PanelLoading what={t("start.loading")} />
        </main>
      );
    case "failed":
      return (
        <main className="alone">
          <div className="card">
            <PanelFailed
              what={t("start.failed")}
              error={session.problem}
              onRetry={() => void loadSession()}
            />
          </div>
        </main>
      );
    case "signed_out":
      return <SignInPage />;
    case "signed_in":
      return (
        <Shell>
          <Page />
        </Shell>
      );
  }
}

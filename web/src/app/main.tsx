import { QueryClient, QueryClientProvider } from "@tanstack/react-query";
import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import { ApiProblem } from "@/shared/api/problem";
import { startI18n } from "@/shared/i18n/setup";
import { whenLinkIsBack } from "@/shared/live/linkBack";
import { kLoads, watchLoads } from "@/shared/live/loads";
import { loadSession } from "@/shared/live/session";
import { liveStore } from "@/shared/live/store";
import "./app.css";
import { Sprite } from "@/shared/ui";
import { App } from "./App";
import "@/shared/styles/stale.css";

const queries = new QueryClient({
  defaultOptions: {
    queries: {
      refetchOnWindowFocus: false,
      retry: (tries, error) =>
        tries < 2 && !(error instanceof ApiProblem && error.status >= 400 && error.status < 500),
    },
  },
});

// What could not be asked while the link was cut is asked again, without a press.
whenLinkIsBack(
  liveStore,
  () => void queries.refetchQueries({ type: "active", predicate: (query) => query.state.status === "error" }),
);

watchLoads(liveStore, () => void queries.invalidateQueries({ queryKey: kLoads }));

const root = document.getElementById("root");
if (root === null) throw new Error("index.html has no #root");

await startI18n(window.location.search);
createRoot(root).render(
  <StrictMode>
    <QueryClientProvider client={queries}>
      <Sprite />
      <App />
    </QueryClientProvider>
  </StrictMode>,
);
void loadSession();

import { QueryClient, QueryClientProvider } from "@tanstack/react-query";
import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import { ApiProblem } from "@/shared/api/problem";
import { startI18n } from "@/shared/i18n/setup";
import { loadSession } from "@/shared/live/session";
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

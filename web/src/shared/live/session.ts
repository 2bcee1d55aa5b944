import { useSyncExternalStore } from "react";
import { api, call, setCsrfToken, setUnauthorisedHandler } from "@/shared/api/client";
import { ApiProblem } from "@/shared/api/problem";
import { Stream } from "@/shared/api/stream";
import type { Session } from "@/shared/api/types";
import { watchClosures } from "./closures";
import { liveStore } from "./store";

export type SessionState =
  | { kind: "loading" }
  | { kind: "failed"; problem: ApiProblem }
  /** `ended`: whose session the server has ended, and when this page heard of it; absent: nobody was signed in, or signed out here. */
  | { kind: "signed_out"; ended?: { name: string; atMs: number } }
  | { kind: "signed_in"; session: Session };

/** Whom this tab has signed in, so that a page that is loaded again can say whose session has ended meanwhile. */
const kSignedIn = "pulseline.signed_in";
const kEnded = "pulseline.session_ended";
const kRetryMs = 3000;

let state: SessionState = { kind: "loading" };
let stream: Stream | undefined;
let closures: (() => void) | undefined;
let retry: ReturnType<typeof setTimeout> | undefined;
const listeners = new Set<() => void>();

function become(next: SessionState): void {
  state = next;
  setCsrfToken(next.kind === "signed_in" ? next.session.csrf_token : "");
  if (next.kind === "signed_in") {
    sessionStorage.setItem(kSignedIn, next.session.name);
    sessionStorage.removeItem(kEnded);
    if (stream === undefined) {
      // A 401 here signs out through the handler; anything else is the link's own trouble.
      stream = new Stream(liveStore, () => void call(api.GET("/api/v1/session")).catch(() => {}));
      stream.start();
      closures = watchClosures(liveStore, async () => (await call(api.GET("/api/v1/traffic"))).closures);
    }
  } else {
    stream?.stop();
    stream = undefined;
    closures?.();
    closures = undefined;
    liveStore.clear();
  }
  for (const listener of listeners) listener();
}

setUnauthorisedHandler(() => {
  if (state.kind === "signed_in") becomeEnded();
});

/** Signed out by the server: it is said, because nobody pressed anything, and again when the page is loaded again. */
function becomeEnded(): void {
  const told = sessionStorage.getItem(kEnded);
  const name = sessionStorage.getItem(kSignedIn);
  const ended =
    told !== null
      ? (JSON.parse(told) as { name: string; atMs: number })
      : name !== null
        ? { name, atMs: Date.now() }
        : undefined;
  if (ended) sessionStorage.setItem(kEnded, JSON.stringify(ended));
  become({ kind: "signed_out", ...(ended && { ended }) });
}

/** Asks the server who is signed in, again by itself until it answers. Called at start and by "Try again". */
export async function loadSession(): Promise<void> {
  clearTimeout(retry);
  try {
    become({ kind: "signed_in", session: await call(api.GET("/api/v1/session")) });
  } catch (error) {
    if (error instanceof ApiProblem && error.status === 401) becomeEnded();
    else {
      become({ kind: "failed", problem: asProblem(error) });
      retry = setTimeout(() => void loadSession(), kRetryMs);
    }
  }
}

/** Throws ApiProblem when refused. */
export async function signIn(name: string, password: string): Promise<void> {
  become({
    kind: "signed_in",
    session: await call(api.POST("/api/v1/session", { body: { name, password } })),
  });
}

export async function signOut(): Promise<void> {
  try {
    await call(api.DELETE("/api/v1/session"));
  } finally {
    sessionStorage.removeItem(kSignedIn);
    become({ kind: "signed_out" });
  }
}

function asProblem(error: unknown): ApiProblem {
  return error instanceof ApiProblem ? error : new ApiProblem({ status: 0, code: "unexpected_answer" });
}

const subscribe = (listener: () => void) => {
  listeners.add(listener);
  return () => void listeners.delete(listener);
};

export function useSessionState(): SessionState {
  return useSyncExternalStore(subscribe, () => state);
}

/** The signed-in user; undefined while signed out or loading. */
export function useSession(): Session | undefined {
  const current = useSessionState();
  return current.kind === "signed_in" ? current.session : undefined;
}

/** Whether the signed-in user may give commands (viewers only look). */
export function useMayCommand(): boolean {
  const role = useSession()?.role;
  return role !== undefined && role !== "viewer";
}

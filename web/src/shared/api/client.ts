import createClient, { type Middleware } from "openapi-fetch";
import { ApiProblem, problemOf } from "./problem";
import type { paths } from "./schema";

/** How long a request may stay unanswered before the screen says so. */
export const kRequestTimeoutMs = 5000;

let csrfToken = "";
let onUnauthorised: () => void = () => {};

/** Set by the session; sent with every change. */
export function setCsrfToken(token: string): void {
  csrfToken = token;
}

/** Called when the server no longer knows the session. */
export function setUnauthorisedHandler(handler: () => void): void {
  onUnauthorised = handler;
}

const csrf: Middleware = {
  onRequest({ request }) {
    if (request.method !== "GET" && request.method !== "HEAD" && csrfToken !== "") {
      request.headers.set("X-Pulseline-CSRF", csrfToken);
    }
    return request;
  },
};

async function timedFetch(request: Request): Promise<Response> {
  const signal = AbortSignal.any([request.signal, AbortSignal.timeout(kRequestTimeoutMs)]);
  try {
    return await fetch(request, { signal });
  } catch (error) {
    if (request.signal.aborted) throw error;
    const late = error instanceof DOMException && error.name === "TimeoutError";
    throw new ApiProblem({ status: 0, code: late ? "no_answer" : "no_connection" });
  }
}

/** Every request of the dashboard is made here. `baseUrl` is the page's own origin. */
export const api = createClient<paths>({
  baseUrl: typeof window === "undefined" ? "http://localhost" : window.location.origin,
  credentials: "same-origin",
  fetch: timedFetch,
});
api.use(csrf);

interface Answer<T> {
  data?: T;
  error?: unknown;
  response: Response;
}

/** Unwraps an answer: the data, or a thrown ApiProblem. `const v = await call(api.GET(...))`. */
export async function call<T>(pending: Promise<Answer<T>>): Promise<T> {
  const { data, error, response } = await pending;
  if (response.ok) return data as T;
  if (response.status === 401) onUnauthorised();
  throw problemOf(response.status, error);
}

/** As `call`, with the ETag that a change of what has come names. */
export async function callTagged<T>(pending: Promise<Answer<T>>): Promise<{ data: T; etag: string }> {
  const data = await call(pending);
  const { response } = await pending;
  const etag = response.headers.get("ETag");
  if (etag === null) throw problemOf(response.status, undefined);
  return { data, etag };
}

import type { Params, Problem } from "./types";

/** What went wrong with a request, always with a code the screen can put into words. */
export class ApiProblem extends Error {
  readonly status: number;
  readonly code: string;
  readonly detail: string;
  readonly params: Params;
  readonly requestId: string;
  readonly field: string | undefined;

  constructor(problem: Partial<Problem> & { status: number; code: string }) {
    super(problem.detail ?? problem.title ?? problem.code);
    this.name = "ApiProblem";
    this.status = problem.status;
    this.code = problem.code;
    this.detail = problem.detail ?? "";
    this.params = problem.params ?? {};
    this.requestId = problem.request_id ?? "";
    this.field = problem.field;
  }
}

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

function paramsOf(value: unknown): Params {
  if (!isRecord(value)) return {};
  const params: Params = {};
  for (const [name, item] of Object.entries(value)) {
    if (typeof item === "string" || typeof item === "number" || typeof item === "boolean")
      params[name] = item;
  }
  return params;
}

/** Reads the body of an answer that was no success; a proxy's HTML page becomes a plain problem. */
export function problemOf(status: number, body: unknown): ApiProblem {
  if (isRecord(body) && typeof body.code === "string") {
    return new ApiProblem({
      status,
      code: body.code,
      params: paramsOf(body.params),
      ...(typeof body.title === "string" && { title: body.title }),
      ...(typeof body.detail === "string" && { detail: body.detail }),
      ...(typeof body.request_id === "string" && { request_id: body.request_id }),
      ...(typeof body.field === "string" && { field: body.field }),
    });
  }
  return new ApiProblem({ status, code: "unexpected_answer", params: { status } });
}

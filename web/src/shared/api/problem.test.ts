import { expect, it } from "vitest";
import { problemOf } from "./problem";

it("reads a problem document", () => {
  const problem = problemOf(422, {
    code: "unknown_station",
    detail: "No.",
    params: { station: 99, deep: {} },
    request_id: "r",
    field: "/steps/0",
  });
  expect([problem.code, problem.detail, problem.params, problem.requestId, problem.field]).toEqual([
    "unknown_station",
    "No.",
    { station: 99 },
    "r",
    "/steps/0",
  ]);
});

it.each([undefined, null, "<html>", 7, [], {}, { code: 3 }])("turns %j into a plain problem", (body) => {
  expect([problemOf(502, body).code, problemOf(502, body).params]).toEqual([
    "unexpected_answer",
    { status: 502 },
  ]);
});

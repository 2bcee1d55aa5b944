import { afterEach, expect, it, vi } from "vitest";
import { api, callTagged } from "./client";

afterEach(() => vi.unstubAllGlobals());
const ask = (headers: Record<string, string>) => {
  vi.stubGlobal("fetch", () => Promise.resolve(Response.json({ id: "A-1" }, { headers })));
  return callTagged(api.GET("/api/v1/loads/{id}", { params: { path: { id: "A-1" } } }));
};

it("tells an answer together with its ETag", async () =>
  expect(await ask({ ETag: '"7f3a"' })).toEqual({ data: { id: "A-1" }, etag: '"7f3a"' }));

it("takes no answer for one that may be changed that has none", async () =>
  expect(await ask({}).catch((error: unknown) => error)).toMatchObject({ code: "unexpected_answer" }));

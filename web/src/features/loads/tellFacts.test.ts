import { afterEach, expect, it, vi } from "vitest";
import { ApiProblem, type Load } from "@/shared/api";
import { tellFacts, withLoad } from "./tellFacts";

const asked: Request[] = [];
function answering(status: number, body: unknown) {
  asked.length = 0;
  vi.stubGlobal("fetch", (request: Request) => {
    asked.push(request);
    return Promise.resolve(Response.json(body, { status }));
  });
}
afterEach(() => vi.unstubAllGlobals());

const facts = { kind: "airframe", mass_kg: 18350 } as const;

it("puts a new load only where there is none of that id", async () => {
  answering(201, { id: "A/1" });

  expect(await tellFacts("A/1", facts, undefined)).toEqual({ id: "A/1" });
  expect(asked.map(({ method, url }) => `${method} ${new URL(url).pathname}`)).toEqual([
    "PUT /api/v1/loads/A%2F1",
  ]);
  expect(asked[0]?.headers.get("If-None-Match")).toBe("*");
  expect(asked[0]?.headers.get("If-Match")).toBeNull();
  expect(await asked[0]?.json()).toEqual(facts);
});

it("changes a known one only as it was seen", async () => {
  answering(200, { id: "A-1" });

  await tellFacts("A-1", facts, '"7f3a"');
  expect(asked[0]?.headers.get("If-Match")).toBe('"7f3a"');
  expect(asked[0]?.headers.get("If-None-Match")).toBeNull();
});

it("says why it was refused, and of which field", async () => {
  answering(422, { code: "load_too_heavy", field: "/mass_kg", params: { load_kg: 30000 } });

  const refused = await tellFacts("A-1", facts, undefined).catch((error: unknown) => error);
  expect(refused).toBeInstanceOf(ApiProblem);
  expect(refused).toMatchObject({ status: 422, code: "load_too_heavy", field: "/mass_kg" });
});

it("shows a load where the list has it, whether it is new or known", () => {
  const load = (id: string, name = id) => ({ id, name }) as Load;
  const list = [load("A-1"), load("A-3")];
  const after = (one: Load) => withLoad(list, one).map(({ id, name }) => `${id} ${name}`);

  expect(after(load("A-2"))).toEqual(["A-1 A-1", "A-2 A-2", "A-3 A-3"]);
  expect(after(load("A-9"))).toEqual(["A-1 A-1", "A-3 A-3", "A-9 A-9"]);
  expect(after(load("A-3", "Three"))).toEqual(["A-1 A-1", "A-3 Three"]);
});

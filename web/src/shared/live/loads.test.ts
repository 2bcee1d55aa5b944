import { QueryClient } from "@tanstack/react-query";
import { expect, it, vi } from "vitest";
import type { Load, StreamFrame } from "@/shared/api/types";
import { kLoads, takeChange, watchLoads } from "./loads";
import { LiveStore } from "./store";

const event = (type: string) => ({ type: "event", event: { type } }) as unknown as StreamFrame;
const named = (id: string) => ({ id }) as Load;

it("asks again at each event about loads, and at no other, until its end", () => {
  const store = new LiveStore((flush) => flush());
  const again = vi.fn();
  const end = watchLoads(store, again);

  for (const type of ["vehicle.lost", "load.registered", "floor.closed", "load.moved"])
    store.apply(event(type));
  expect(again).toHaveBeenCalledTimes(2);

  store.clear(); // signed out: there is nobody to ask for
  expect(again).toHaveBeenCalledTimes(2);
  end();
  store.apply(event("load.retired"));
  expect(again).toHaveBeenCalledTimes(2);
});

it("shows what a change has answered at once, whatever was asked before it", async () => {
  const queries = new QueryClient();
  queries.setQueryData(kLoads, [named("A-1")]);
  let late: (loads: Load[]) => void = () => {};
  void queries
    .fetchQuery({ queryKey: kLoads, queryFn: () => new Promise<Load[]>((resolve) => (late = resolve)) })
    .catch(() => {});

  await takeChange(queries, (known) => [...known, named("A-2")]);
  late([named("A-1")]);
  await Promise.resolve();

  expect(queries.getQueryData<Load[]>(kLoads)?.map(({ id }) => id)).toEqual(["A-1", "A-2"]);
  expect(queries.getQueryState(kLoads)?.isInvalidated).toBe(true);
});

it("has nothing to change before the list has come", async () => {
  const queries = new QueryClient();
  await takeChange(queries, (known) => [...known, named("A-2")]);
  expect(queries.getQueryData(kLoads)).toBeUndefined();
});

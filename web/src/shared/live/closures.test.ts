import { expect, it, vi } from "vitest";
import type { Closure, StreamFrame } from "@/shared/api/types";
import { watchClosures } from "./closures";
import { LiveStore } from "./store";

const closure = (name: string) =>
  ({ id: name, name, edges: [], created_by: "op", created_at: "" }) as Closure;
const floorEvent = (type: string) => ({ type: "event", event: { type } }) as unknown as StreamFrame;
const newStore = () =>
  new LiveStore(
    (flush) => flush(),
    () => 0,
    () => 0,
  );

it("asks when an event says that floor was closed or reopened, and not at any other", async () => {
  const store = newStore();
  const ask = vi.fn(() => Promise.resolve([closure("paint")]));
  const end = watchClosures(store, ask);
  store.apply(floorEvent("vehicle.lost"));
  expect(ask).toHaveBeenCalledTimes(0);
  store.apply(floorEvent("floor.closed"));
  await vi.waitFor(() => expect(store.state.closures.map((c) => c.name)).toEqual(["paint"]));
  store.apply(floorEvent("floor.reopened"));
  expect(ask).toHaveBeenCalledTimes(2);
  end();
});

it("takes the answer to the newest question, whichever comes last", async () => {
  const store = newStore();
  const answers: ((list: Closure[]) => void)[] = [];
  const end = watchClosures(store, () => new Promise((resolve) => answers.push(resolve)));
  store.apply(floorEvent("floor.closed"));
  store.apply(floorEvent("floor.reopened"));
  answers[1]?.([]);
  await Promise.resolve();
  answers[0]?.([closure("paint")]);
  await Promise.resolve();
  await Promise.resolve();
  expect(store.state.closures).toEqual([]);
  end();
});

it("asks again after a failure", async () => {
  vi.useFakeTimers();
  const store = newStore();
  const ask = vi
    .fn()
    .mockRejectedValueOnce(new Error("gone"))
    .mockResolvedValue([closure("paint")]);
  const end = watchClosures(store, ask);
  store.apply(floorEvent("floor.closed"));
  await vi.advanceTimersByTimeAsync(3100);
  expect(store.state.closures).toHaveLength(1);
  end();
  vi.useRealTimers();
});

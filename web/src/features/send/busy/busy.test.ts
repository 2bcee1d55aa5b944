import { describe, expect, it } from "vitest";
import type { JobOrder, Plant } from "@/shared/api/types";
import { busyKey, busyWith, goesTo, startsAt } from "./busy";
import { notCancelled } from "./replacing";
import { sendAddress } from "../sendAddress";

const order = (number: number, over: Partial<JobOrder> = {}) =>
  ({
    id: `o${number}`,
    number,
    state: "AllowedToStart",
    vehicle: "",
    wanted_vehicle: "TP-01",
    steps: [{ number: 7 }, { number: 8 }],
    current_step: 0,
    ...over,
  }) as JobOrder;
const running = order(7, { state: "Running", vehicle: "TP-01" });
const vehicle = { id: "TP-01", order: "o7" };

describe("busyWith", () => {
  it.each<[string, JobOrder[], { order: string; has: boolean; waiting: string[] } | undefined]>([
    ["nothing", [], undefined],
    ["what has ended", [order(7, { state: "Ended" }), order(8, { state: "Aborted" })], undefined],
    [
      "another vehicle's",
      [order(7, { wanted_vehicle: "TP-02", vehicle: "TP-02", state: "Running" })],
      undefined,
    ],
    ["its order", [running], { order: "o7", has: true, waiting: [] }],
    ["its order and one behind it", [order(9), running], { order: "o7", has: true, waiting: ["o9"] }],
    ["one that waits for it", [order(9), order(8)], { order: "o8", has: false, waiting: ["o9"] }],
    [
      "one it got though it was not named",
      [order(7, { wanted_vehicle: "", vehicle: "TP-01" })],
      { order: "o7", has: true, waiting: [] },
    ],
  ])("%s", (_, orders, expected) => {
    const busy = busyWith(vehicle, orders);

    expect(busy && { order: busy.order.id, has: busy.has, waiting: busy.waiting.map((o) => o.id) }).toEqual(
      expected,
    );
  });
  it("leaves out the order that asks", () => {
    expect(busyWith(vehicle, [running, order(9)], "o9")?.waiting).toEqual([]);
    expect(busyWith(vehicle, [running], "o7")).toBeUndefined();
    expect(busyWith(undefined, [running])).toBeUndefined();
  });
  it("has another key when another order comes between", () => {
    const keys = [[], [running], [running, order(9)]].map((orders) => busyKey(busyWith(vehicle, orders)));

    expect(new Set(keys).size).toBe(3);
    expect(keys[0]).toBe("");
  });
});

describe("an order's station", () => {
  it.each([
    [0, 7],
    [1, 8],
    [2, 8],
  ])("at step %s is %s", (current_step, number) => expect(goesTo(order(1, { current_step }))).toBe(number));
});

describe("where a preview begins", () => {
  const plant = { stations: [{ number: 7, pose: { x_m: 95, y_m: 20, heading_rad: 0 } }] } as Plant;
  it.each([
    ["the drawn pose of a station", { x_m: 95, y_m: 20, heading_rad: 0 }, 7],
    ["beside it", { x_m: 95.01, y_m: 20, heading_rad: 0 }, undefined],
  ])("%s", (_, start, number) => expect(startsAt(start, plant)).toBe(number));
  it("is nowhere before there is one", () => expect(startsAt(undefined, plant)).toBeUndefined());
});

describe("notCancelled", () => {
  const other = { id: "o7", name: "JO-7", created_by: "anna" };
  const problem = (code: string, status: number) => ({ code, status, params: {}, detail: "", requestId: "" });
  it.each([
    ["it had ended by itself", problem("not_in_this_state", 409), "had_ended"],
    ["it is there no more", problem("unknown_job_order", 404), "had_ended"],
    ["the link was cut", problem("no_connection", 0), "failed"],
    ["the server cannot store", problem("store_unavailable", 503), "failed"],
  ])("%s", (_, why, kind) => expect(notCancelled(other, why)).toMatchObject({ kind, order: other }));
});

describe("sendAddress", () => {
  it.each([
    ["", { vehicle: "TP-01" }, "/send?vehicle=TP-01"],
    ["?vehicle=TP-01&station=7", { station: "" }, "/send?vehicle=TP-01"],
    ["?vehicle=TP-01&station=7&lang=zh", { order: "o" }, "/send?vehicle=TP-01&station=7&order=o"],
    ["?vehicle=TP-01&station=7&order=o", { order: undefined }, "/send?vehicle=TP-01&station=7"],
    ["?order=o", { order: undefined }, "/send"],
  ])("%s with %o is %s", (now, change, address) => expect(sendAddress(change, now)).toBe(address));
});

import { expect, it } from "vitest";
import type { Vehicle } from "@/shared/api/types";
import { lightWords, navigationWords, poseWords, reflectorWords } from "./poseBasis";

type Basis = NonNullable<Vehicle["pose_basis"]>;
const said = (pose_basis: Basis | undefined, pose_known = true) =>
  poseWords(
    { pose_known, ...(pose_basis && { pose_basis }) } as Vehicle,
    (station) => station.slice(2),
    (at) => at.slice(11, 19),
    (actor) => actor,
  );
const at = "2026-11-24T20:15:03Z";

it.each<[string, ReturnType<typeof said>, [string, object, string | undefined]]>([
  ["not known", said(undefined, false), ["unknown", {}, undefined]],
  [
    "measured, and still there",
    said({ kind: "stop", station: "st27", at, driven_m: 0.01 }),
    ["stop", { number: "27", time: "20:15:03" }, undefined],
  ],
  [
    "measured 12 m ago",
    said({ kind: "stop", station: "st27", at, driven_m: 12.34 }),
    ["stop", { number: "27", time: "20:15:03" }, "12.34\u00a0m"],
  ],
  ["seen by codes", said({ kind: "codes", at, driven_m: 0 }), ["codes", { time: "20:15:03" }, undefined]],
  [
    "seen by iGPS",
    said({ kind: "receivers", at, driven_m: 0 }),
    ["receivers", { time: "20:15:03" }, undefined],
  ],
  [
    "seen by reflectors",
    said({ kind: "reflectors", at, driven_m: 0 }),
    ["reflectors", { time: "20:15:03" }, undefined],
  ],
  [
    "said by a person",
    said({ kind: "statement", by: "ann", at, driven_m: 3 }),
    ["statement", { by: "ann", time: "20:15:03" }, "3.00\u00a0m"],
  ],
  [
    "the vehicle's own word",
    said({ kind: "vehicle", at, driven_m: 240 }),
    ["vehicle", { time: "20:15:03" }, "240\u00a0m"],
  ],
])("%s", (_, { key, values, since }, expected) => expect([key, values, since]).toEqual(expected));

type Receiver = NonNullable<Vehicle["receivers"]>[number];
const lit = (name: string, ...transmitters: string[]): Receiver => ({
  name,
  found: true,
  place: { x_m: 1, y_m: 2 },
  z_m: 0.55,
  sigma_m: 6e-5,
  transmitters,
});
const dark = (name: string, ...transmitters: string[]): Receiver => ({
  name,
  found: false,
  transmitters,
  why_not: "too_few_transmitters",
});

it.each<[string, Receiver[], object | undefined]>([
  ["no receivers", [], undefined],
  [
    "all in the light",
    [lit("front", "tx-1", "tx-2"), lit("rear", "tx-2", "tx-3")],
    { key: "all", values: { lit: "2", all: "2", transmitters: "3", sigma: "0.06" } },
  ],
  [
    "one in the dark",
    [lit("front", "tx-1", "tx-2"), lit("left", "tx-1", "tx-2"), dark("rear", "tx-2")],
    { key: "some", values: { lit: "2", all: "3", transmitters: "2", sigma: "0.06" } },
  ],
  [
    "too few",
    [lit("front", "tx-1", "tx-2"), dark("rear")],
    { key: "none", values: { lit: "1", all: "2", transmitters: "2", sigma: "0.06" } },
  ],
])("light: %s", (_, receivers, expected) => expect(lightWords({ receivers } as Vehicle)).toEqual(expected));

it.each<[number | undefined, object | undefined]>([
  [undefined, undefined],
  [0, { key: "none", values: { seen: "0" } }],
  [2, { key: "some", values: { seen: "2" } }],
  [7, { key: "all", values: { seen: "7" } }],
])("%s reflectors in view", (seen, expected) =>
  expect(reflectorWords({ reflectors_in_view: seen } as Vehicle)).toEqual(expected),
);

it.each<[string, Vehicle["navigation"], object | undefined]>([
  ["it does not say", undefined, undefined],
  [
    "just corrected",
    { by: "codes", driven_m: 0.01 },
    { key: "codes", since: undefined, explained: undefined, whyNot: undefined },
  ],
  [
    "by its map",
    { by: "contours", driven_m: 1.5, explained: 0.917 },
    { key: "contours", since: "1.50\u00a0m", explained: "92", whyNot: undefined },
  ],
  [
    "not on its map",
    { by: "person", driven_m: 0, explained: 0.2, why_not: "contours_lost" },
    { key: "person", since: undefined, explained: "20", whyNot: "contours_lost" },
  ],
])("steers: %s", (_, navigation, expected) =>
  expect(navigationWords({ navigation } as Vehicle)).toEqual(expected),
);

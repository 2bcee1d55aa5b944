import { expect, it } from "vitest";
import { inCapitals } from "./captions";

it.each([
  ["A Pulse line", "A PULSE LINE"],
  ["C iGPS cell", "C iGPS CELL"],
  ["C iGPS 工作区", "C iGPS 工作区"],
])("%s is written %s", (name, caption) => expect(inCapitals(name)).toBe(caption));

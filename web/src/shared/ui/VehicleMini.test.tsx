import { readFileSync } from "node:fs";
import { renderToStaticMarkup } from "react-dom/server";
import { describe, expect, it } from "vitest";
import type { Plant } from "@/shared/api/types";
import { VehicleMini } from "./VehicleMini";

const plant = JSON.parse(
  readFileSync(new URL("../../../../db/plants/final-assembly.json", import.meta.url), "utf8"),
) as Plant;
const drawn = plant.vehicle_types.map((type) => renderToStaticMarkup(<VehicleMini type={type} />));

describe("small drawing of a vehicle", () => {
  it("is another one for each family", () => {
    expect(drawn.length).toBeGreaterThan(1);
    expect(new Set(drawn).size).toBe(drawn.length);
  });
  it.each(plant.vehicle_types.map((type, i) => [type.id, type, drawn[i]!] as const))(
    "has the outline and the wheels of %s",
    (_, type, svg) => {
      expect(/d="M([^"]*)Z"/.exec(svg)?.[1]?.split("L")).toHaveLength(type.footprint.length);
      expect(svg.match(/<rect/g)).toHaveLength(type.wheels.length);
    },
  );
  it("is empty for a type that nobody knows", () =>
    expect(renderToStaticMarkup(<VehicleMini type={undefined} />)).not.toContain("path"));
});

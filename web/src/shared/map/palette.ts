const kNames = [
  "bg",
  "surface",
  "ink",
  "ink-2",
  "ink-3",
  "rule-2",
  "accent",
  "accent-line",
  "on-accent",
  "high-fill",
  "high-edge",
  "on-high",
  "critical-fill",
  "critical",
  "on-critical",
  "map-out",
  "map-floor",
  "map-zone",
  "map-lane",
  "map-grid",
  "map-grid-10",
  "map-wall",
  "map-rule",
  "map-route",
  "map-chevron",
  "map-craft",
  "map-craft-line",
  "map-craft-fine",
  "map-station",
  "map-marker",
  "map-tag",
  "map-tag-ink",
  "veh",
  "veh-mark",
  "veh-sel",
  "veh-sel-mark",
  "veh-halo",
  "grant",
  "grant-fill",
  "horizon",
  "swept",
  "swept-hatch",
] as const;
export type ColourName = (typeof kNames)[number];
export type Palette = Readonly<Record<ColourName, string>> & { readonly font: string };

/** The tokens of the theme in force, for the canvas. */
export function readPalette(element: Element): Palette {
  const style = getComputedStyle(element);
  const colours = Object.fromEntries(
    kNames.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]),
  );
  return { ...(colours as Record<ColourName, string>), font: style.getPropertyValue("--font").trim() };
}

const kKept = ["vehicle", "station", "order", "view"] as const;
type Kept = (typeof kKept)[number];

/**
 * The address of Send with what has been chosen: whoever is signed out, goes back or loads the page again
 * finds vehicle, station, the order that is watched and what is looked at as they were. What `change` does not name stays.
 */
export function sendAddress(
  change: Partial<Record<Kept, string | undefined>>,
  now: string = window.location.search,
): string {
  const was = new URLSearchParams(now);
  const next = new URLSearchParams();
  for (const name of kKept) {
    const value = name in change ? change[name] : was.get(name);
    if (value) next.set(name, value);
  }
  const text = next.toString();
  return text === "" ? "/send" : `/send?${text}`;
}

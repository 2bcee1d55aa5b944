import sprite from "./sprite.svg?raw";

export type IconName =
  | "map"
  | "send"
  | "orders"
  | "stations"
  | "veh"
  | "load"
  | "alarm"
  | "rec"
  | "eng"
  | "pause"
  | "play"
  | "chev"
  | "search"
  | "plus"
  | "minus"
  | "fit"
  | "follow"
  | "layers"
  | "sun"
  | "link"
  | "right"
  | "back"
  | "x"
  | "del"
  | "out";

/** moving .. measure: what a vehicle does; a-1 .. a-3: alarm priority; c-ok, c-no: result of a check. */
export type SymbolName =
  | "s-moving"
  | "s-stand"
  | "s-feet"
  | "s-wait"
  | "s-charge"
  | "s-stale"
  | "s-measure"
  | "a-1"
  | "a-1o"
  | "a-2"
  | "a-2s"
  | "a-3"
  | "c-ok"
  | "c-no";

export type ModeIconName = "m-auto" | "m-lin" | "m-arc" | "m-rot" | "m-lat" | "m-obl" | "m-comb" | "m-free";

/** All pictograms, once in the document; Icon and Symbol refer to them. */
export function Sprite() {
  return <div hidden style={{ display: "contents" }} dangerouslySetInnerHTML={{ __html: sprite }} />;
}

/** A line icon of 24 px. Never without a word or an accessible name beside it. */
export function Icon({ name, size, className }: { name: IconName; size?: number; className?: string }) {
  return (
    <svg
      className={`i ${className ?? ""}`}
      viewBox="0 0 24 24"
      aria-hidden="true"
      {...(size !== undefined && { style: { width: size, height: size } })}
    >
      <use href={`#i-${name}`} />
    </svg>
  );
}

/** A status shape of 18 px in the colour of the text (alarm shapes carry their own colours). */
export function StatusSymbol({
  name,
  size,
  className,
}: {
  name: SymbolName;
  size?: number;
  className?: string;
}) {
  return (
    <svg
      className={`g ${className ?? ""}`}
      aria-hidden="true"
      {...(size !== undefined && { style: { width: size, height: size } })}
    >
      <use href={`#${name}`} />
    </svg>
  );
}

/** Pictogram of a motion mode, 40 x 28. */
export function ModeIcon({ name }: { name: ModeIconName }) {
  return (
    <svg
      viewBox="0 0 40 28"
      width="40"
      height="28"
      fill="none"
      stroke="currentColor"
      strokeWidth="2.2"
      strokeLinecap="round"
      strokeLinejoin="round"
      aria-hidden="true"
    >
      <use href={`#${name}`} />
    </svg>
  );
}

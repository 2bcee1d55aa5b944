import { kAll } from "./lifts";

/** One of them, or all. */
export function Choice(props: {
  label: string;
  all: string;
  names: readonly { name: string; label: string }[];
  chosen: string;
  onChoose: (name: string) => void;
}) {
  const { label, all, names, chosen, onChoose } = props;
  return (
    <div className="seg" role="group" aria-label={label}>
      {[{ name: kAll, label: all }, ...names].map((one) => (
        <button
          key={one.name}
          type="button"
          aria-pressed={chosen === one.name}
          onClick={() => onChoose(one.name)}
        >
          {one.label}
        </button>
      ))}
    </div>
  );
}

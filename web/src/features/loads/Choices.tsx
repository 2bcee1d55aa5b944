interface Props<T extends string> {
  label: string;
  options: readonly { id: T; name: string }[];
  chosen: readonly string[];
  /** Id of the words that say what is wrong with what is chosen. */
  why: string | undefined;
  onPress: (id: T) => void;
}

/** Buttons of which those that are pressed are chosen. */
export function Choices<T extends string>({ label, options, chosen, why, onPress }: Props<T>) {
  return (
    <div role="group" aria-label={label} aria-describedby={why}>
      <span className="cap">{label}</span>
      <div className={`lchoice ${why === undefined ? "" : "wrong"}`}>
        {options.map(({ id, name }) => (
          <button
            key={id}
            type="button"
            className="btn"
            aria-pressed={chosen.includes(id)}
            onClick={() => onPress(id)}
          >
            {name}
          </button>
        ))}
      </div>
    </div>
  );
}

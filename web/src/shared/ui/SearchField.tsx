import "./SearchField.css";

/** Narrows a list while one types. What it looks through stands above it. */
export function SearchField({
  label,
  text,
  onText,
}: {
  label: string;
  text: string;
  onText: (text: string) => void;
}) {
  return (
    <label className="field searchfield">
      <span className="cap">{label}</span>
      <input type="search" value={text} onChange={(event) => onText(event.target.value)} />
    </label>
  );
}

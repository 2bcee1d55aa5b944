interface Props {
  label: string;
  value: string;
  decimal?: boolean;
  longest?: number;
  placeholder?: string;
  /** Id of the words that say what is wrong with it. */
  why: string | undefined;
  onChange: (value: string) => void;
}

export function TextField({ label, value, decimal, longest, placeholder, why, onChange }: Props) {
  return (
    <label className="field">
      <span className="cap">{label}</span>
      <input
        type="text"
        inputMode={decimal ? "decimal" : "text"}
        maxLength={longest}
        placeholder={placeholder}
        value={value}
        aria-invalid={why !== undefined}
        aria-describedby={why}
        onChange={(event) => onChange(event.target.value)}
      />
    </label>
  );
}

import "./ArrivalRow.css";

export interface ArrivalRowProps {
  label: string;
  on: boolean;
  onChange: (on: boolean) => void;
}

/** One thing that the vehicle does when its stop is inside the tolerance, or does not. */
export function ArrivalRow({ label, on, onChange }: ArrivalRowProps) {
  return (
    <label className="row arrivalrow">
      <input type="checkbox" checked={on} onChange={(event) => onChange(event.target.checked)} />
      <span>{label}</span>
    </label>
  );
}

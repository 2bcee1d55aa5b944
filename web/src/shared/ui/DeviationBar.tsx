/** A deviation on its tolerance band: the band takes 5/6 of the width, so that outside can be seen. */
export function DeviationBar(props: {
  name: string;
  text: string;
  unit?: string;
  /** In the unit of `limit`. */
  value: number;
  limit: number;
  limitText: string;
}) {
  const x = 50 + Math.max(-1.18, Math.min(1.18, props.value / props.limit)) * 41.67;
  return (
    <div className="dv">
      <div className="dl">{props.name}</div>
      <div className="val lg">
        <b>{props.text}</b>
        {props.unit && <u>{props.unit}</u>}
      </div>
      <div className="gw">
        <svg className="gg" viewBox="0 0 100 28" preserveAspectRatio="none" aria-hidden="true">
          <rect x="0" y="10" width="100" height="8" fill="var(--surface-3)" />
          <rect x="8.33" y="6" width="83.33" height="16" fill="var(--band)" />
          <path
            d="M8.33 2V26M91.67 2V26"
            stroke="var(--ink-2)"
            strokeWidth="1.5"
            vectorEffect="non-scaling-stroke"
          />
          <path d="M50 6V22" stroke="var(--band-edge)" strokeWidth="1" vectorEffect="non-scaling-stroke" />
          <path d={`M${x} 0V28`} stroke="var(--needle)" strokeWidth="4" vectorEffect="non-scaling-stroke" />
        </svg>
        <div className="gt">
          <span style={{ left: "8.33%" }}>−{props.limitText}</span>
          <span style={{ left: "50%" }}>0</span>
          <span style={{ left: "91.67%" }}>+{props.limitText}</span>
        </div>
      </div>
    </div>
  );
}

// Whether something grows: a straight line through samples with the error of its slope, and how large a database may be.

/** Slope of y over x in y's unit per x's unit, and its standard error, from means of some samples each: what follows itself
 * from sample to sample (a snapshot being written) would make the error look smaller than it is. `breaks` are the x at which
 * something from outside moved the level (a standstill of the machine, whose backlog had to be held): one slope, each part
 * its own level. */
export function slope(samples, breaks = [], blocks = 20) {
  const size = Math.max(1, Math.floor(samples.length / blocks));
  const parts = new Map();
  for (const sample of samples) {
    const number = breaks.filter((x) => x <= sample.x).length;
    parts.set(number, [...(parts.get(number) ?? []), sample]);
  }
  const mean = (of, list) => list.reduce((sum, p) => sum + of(p), 0) / list.length;
  const points = [];
  for (const part of parts.values()) {
    const means = [];
    for (let i = 0; i + size <= part.length; i += size) {
      const block = part.slice(i, i + size);
      means.push({ x: mean((p) => p.x, block), y: mean((p) => p.y, block) });
    }
    if (means.length === 0) continue;
    const mx = mean((p) => p.x, means), my = mean((p) => p.y, means);
    points.push(...means.map((p) => ({ x: p.x - mx, y: p.y - my })));
  }
  const sxx = points.reduce((sum, p) => sum + p.x ** 2, 0);
  const value = points.reduce((sum, p) => sum + p.x * p.y, 0) / sxx;
  const rest = points.reduce((sum, p) => sum + (p.y - value * p.x) ** 2, 0);
  return { value, error: Math.sqrt(rest / Math.max(1, points.length - 1 - parts.size) / sxx) };
}

// What a row costs beside what it holds: its cell and page, and its places in the indexes of its table.
const kRow_bytes = { events: 12, journal: 12, orders: 130, job_order_steps: 60, stop_records: 190, idempotency_keys: 130 };
// Pages of a tree that grows at its end are nearly full; ids that sort by time grow there.
const kFilled = 0.92;

/** Bytes of the file's pages in use, from what its tables hold now and the file it began as. */
export function modelOf(fresh, sizes) {
  let grown = sizes.tables.snapshots.bytes - fresh.tables.snapshots.bytes;
  for (const [table, more] of Object.entries(kRow_bytes)) {
    const held = sizes.tables[table], before = fresh.tables[table];
    grown += held.bytes - before.bytes + more * (held.rows - before.rows);
  }
  return fresh.bytes - fresh.free_bytes + grown / kFilled;
}

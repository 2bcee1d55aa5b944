// Whether something grows: a straight line through samples with the error of its slope, and how large a database may be.

/** Slope of y over x in y's unit per x's unit, and its standard error, from the means of `blocks` equal parts: what follows
 * itself from sample to sample (a snapshot being written) would make the error look smaller than it is. */
export function slope(samples, blocks = 20) {
  const size = Math.max(1, Math.floor(samples.length / blocks));
  const points = [];
  for (let i = 0; i + size <= samples.length; i += size) {
    const part = samples.slice(i, i + size);
    points.push({ x: part.reduce((sum, p) => sum + p.x, 0) / size, y: part.reduce((sum, p) => sum + p.y, 0) / size });
  }
  const n = points.length, mean = (of) => points.reduce((sum, p) => sum + of(p), 0) / n;
  const mx = mean((p) => p.x), my = mean((p) => p.y);
  const sxx = points.reduce((sum, p) => sum + (p.x - mx) ** 2, 0);
  const value = points.reduce((sum, p) => sum + (p.x - mx) * (p.y - my), 0) / sxx;
  const rest = points.reduce((sum, p) => sum + (p.y - my - value * (p.x - mx)) ** 2, 0);
  return { value, error: Math.sqrt(rest / Math.max(1, n - 2) / sxx) };
}

// What a row costs beside what it holds: its cell and page, and its places in the indexes of its table.
const kRow_bytes = { events: 12, journal: 12, orders: 130, job_order_steps: 60, stop_records: 190, idempotency_keys: 130 };
// Pages of a tree that grows at its end are nearly full; ids that sort by time grow there.
const kFilled = 0.92;

/** Bytes of the file, from what its tables hold now, the most that journal and snapshots ever held (a file never shrinks)
 * and the file it began as. */
export function modelOf(fresh, sizes, most) {
  let grown = 0;
  for (const [table, more] of Object.entries(kRow_bytes)) {
    const held = table === "journal" ? most.journal : sizes.tables[table], before = fresh.tables[table];
    grown += held.bytes - before.bytes + more * (held.rows - before.rows);
  }
  // A third snapshot is written before the oldest of two is dropped.
  grown += 1.5 * most.snapshots.bytes - fresh.tables.snapshots.bytes;
  return fresh.bytes - fresh.free_bytes + grown / kFilled;
}

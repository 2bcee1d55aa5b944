import { api, call } from "@/shared/api";
import type { Load, LoadFacts } from "@/shared/api/types";

/** Tells the server what is known of a load: of the one that was seen with the ETag, or, without, of a new one. */
export function tellFacts(id: string, facts: LoadFacts, etag: string | undefined): Promise<Load> {
  const header = etag === undefined ? { "If-None-Match": "*" } : { "If-Match": etag };
  return call(api.PUT("/api/v1/loads/{id}", { params: { path: { id }, header }, body: facts }));
}

/** The list with one load as it now is, in the server's order: by id. */
export function withLoad(known: readonly Load[], load: Load): Load[] {
  const before = known.filter(({ id }) => id < load.id);
  return [...before, load, ...known.filter(({ id }) => id > load.id)];
}

import { useQueryClient } from "@tanstack/react-query";
import { useCallback, useMemo, useState } from "react";
import type { Load } from "@/shared/api/types";
import { takeChange } from "@/shared/live";
import { useCommand } from "@/shared/ui/useCommand";
import { draftOf, emptyDraft, pointedAt, readDraft, type FactsDraft } from "./factsDraft";
import { tellFacts, withLoad } from "./tellFacts";

/** A load as it was when somebody began to change what is known of it. */
export interface KnownLoad {
  data: Load;
  etag: string;
}

/** What is being written of a load, new or known, what is wrong with it, and the command that tells it. */
export function useFacts(known: KnownLoad | undefined, onDone: (load: Load) => void) {
  const queries = useQueryClient();
  const [draft, setDraft] = useState(() => (known ? draftOf(known.data) : emptyDraft));
  const result = useMemo(() => readDraft(draft, known?.data), [draft, known]);
  const etag = known?.etag;
  const command = useCommand(
    useCallback(async () => {
      if (result.kind === "wrong") return;
      const load = await tellFacts(result.id, result.facts, etag);
      await takeChange(queries, (others) => withLoad(others, load));
      onDone(load);
    }, [queries, result, etag, onDone]),
  );
  const { asked, reset } = command;
  const refused = asked.kind === "failed" ? asked.problem : undefined;
  const wrong: readonly (keyof FactsDraft)[] =
    result.kind === "wrong" ? (result.field === "id" ? [] : [result.field]) : pointedAt(refused?.field);
  return {
    draft,
    change: (part: Partial<FactsDraft>) => {
      setDraft((before) => ({ ...before, ...part }));
      if (refused) reset();
    },
    fault: result.kind === "wrong" ? result.field : undefined,
    /** Fields to look at. An id that is not there yet is none of them. */
    wrong,
    command,
    /** Somebody else was faster. */
    stale: known !== undefined && refused?.status === 412,
  };
}

import { useCallback, useState } from "react";
import type { MotionMode } from "@/shared/api/types";
import type { BracketsDraft } from "@/shared/body/bracketStep";
import { navigate, useLocation } from "@/shared/router";
import { sendAddress } from "./sendAddress";

export interface Choice {
  vehicle: string | undefined;
  digits: string;
  mode: MotionMode;
  chooseVehicle: (id: string) => void;
  chooseStation: (digits: string) => void;
  chooseMode: (mode: MotionMode) => void;
  /** It lowers its feet on arrival; undefined: as the station is for. */
  park: boolean | undefined;
  choosePark: (park: boolean) => void;
  /** Key of the transfer that is wanted at the station, see steps/transfer. */
  transfer: string | undefined;
  chooseTransfer: (key: string | undefined) => void;
  /** Brackets that move on arrival; undefined: none. */
  brackets: BracketsDraft | undefined;
  chooseBrackets: (brackets: BracketsDraft | undefined) => void;
}

/** Vehicle, station and mode chosen so far. Vehicle and station are kept in the address (see sendAddress). */
export function useChoice(): Choice {
  const { query } = useLocation();
  const [mode, chooseMode] = useState<MotionMode>("auto");
  const [park, choosePark] = useState<boolean>();
  const [transfer, chooseTransfer] = useState<string>();
  const [brackets, chooseBrackets] = useState<BracketsDraft>();
  const choose = useCallback((change: { vehicle?: string; station?: string }) => {
    navigate(sendAddress(change), { replace: true });
    chooseMode("auto");
    chooseTransfer(undefined);
    chooseBrackets(undefined);
  }, []);
  return {
    vehicle: query.get("vehicle") ?? undefined,
    digits: query.get("station") ?? "",
    mode,
    chooseVehicle: useCallback((vehicle) => choose({ vehicle }), [choose]),
    chooseStation: useCallback((station) => choose({ station }), [choose]),
    chooseMode,
    park,
    choosePark,
    transfer,
    chooseTransfer,
    brackets,
    chooseBrackets,
  };
}

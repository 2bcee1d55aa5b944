import type { ReactNode } from "react";
import { StatusSymbol, type SymbolName } from "./Icon";

export function Chip({ symbol, children }: { symbol?: SymbolName; children: ReactNode }) {
  return (
    <span className="chip">
      {symbol && <StatusSymbol name={symbol} />}
      {children}
    </span>
  );
}

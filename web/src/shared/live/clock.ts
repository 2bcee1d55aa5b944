import { useSyncExternalStore } from "react";

export interface Now {
  wallMs: number;
  monoMs: number;
}

interface Ticker {
  now: Now;
  listeners: Set<() => void>;
  timer: ReturnType<typeof setInterval> | undefined;
  subscribe: (listener: () => void) => () => void;
}

const read = (): Now => ({ wallMs: Date.now(), monoMs: performance.now() });
const tickers = new Map<number, Ticker>();

function tickerOf(everyMs: number): Ticker {
  const known = tickers.get(everyMs);
  if (known !== undefined) return known;
  const ticker: Ticker = {
    now: read(),
    listeners: new Set(),
    timer: undefined,
    subscribe: (listener) => {
      ticker.listeners.add(listener);
      ticker.timer ??= setInterval(() => {
        ticker.now = read();
        for (const each of ticker.listeners) each();
      }, everyMs);
      return () => {
        ticker.listeners.delete(listener);
        if (ticker.listeners.size > 0) return;
        clearInterval(ticker.timer);
        ticker.timer = undefined;
      };
    },
  };
  tickers.set(everyMs, ticker);
  return ticker;
}

/** The time, re-rendering every `everyMs`; all users of one period share one timer. */
export function useNow(everyMs: number): Now {
  const ticker = tickerOf(everyMs);
  return useSyncExternalStore(ticker.subscribe, () => ticker.now);
}

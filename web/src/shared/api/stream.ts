import type { LiveStore } from "@/shared/live/store";
import type { StreamFrame } from "./types";

/** Silence after which the link counts as lost. The server sends poses or a fleet frame at least once a second. */
export const kSilenceMs = 2500;
const kRetryMinMs = 500;
const kRetryMaxMs = 10_000;

const kChangeTypes = new Set(["poses", "vehicle", "station", "job_order", "stop_record", "fleet", "event"]);
const kFrameTypes = new Set(["snapshot", "changes", ...kChangeTypes]);

/** Wait before try number `attempt` (0-based): exponential with full jitter, never outside 0.5 to 10 s. */
export function retryDelayMs(attempt: number, random: number): number {
  const ceiling = Math.min(kRetryMaxMs, kRetryMinMs * 2 ** (attempt + 1));
  return kRetryMinMs + random * (ceiling - kRetryMinMs);
}

function isOf(types: ReadonlySet<string>, value: unknown): boolean {
  return typeof value === "object" && value !== null && "type" in value && types.has(String(value.type));
}

/** A frame, or undefined when the text is none. An unknown type is ignored: the server may be newer. */
export function parseFrame(text: unknown): StreamFrame | undefined {
  if (typeof text !== "string") return undefined;
  try {
    const value: unknown = JSON.parse(text);
    if (!isOf(kFrameTypes, value)) return undefined;
    const frame = value as StreamFrame;
    return frame.type === "changes"
      ? { ...frame, changes: frame.changes.filter((change) => isOf(kChangeTypes, change)) }
      : frame;
  } catch {
    return undefined;
  }
}

/** Owns the one WebSocket: connects, reconnects, and feeds the store. `stop()` ends it for good. */
export class Stream {
  private socket: WebSocket | undefined;
  private attempt = 0;
  private heardAt: number | undefined;
  private lostSince: number | undefined;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private watchdog: ReturnType<typeof setInterval> | undefined;
  private lastShown = 0;

  /** `onRetry` is called before each new try: the session may have ended, which a closed socket cannot say. */
  constructor(
    private readonly store: LiveStore,
    private readonly onRetry: () => void = () => {},
    private readonly url: string = `${window.location.origin.replace(/^http/, "ws")}/api/v1/stream`,
  ) {}

  start(): void {
    this.watchdog = setInterval(() => this.watch(), 250);
    window.addEventListener("online", this.retryNow);
    window.addEventListener("offline", this.markOffline);
    this.connect();
  }

  stop(): void {
    clearInterval(this.watchdog);
    clearTimeout(this.timer);
    window.removeEventListener("online", this.retryNow);
    window.removeEventListener("offline", this.markOffline);
    this.drop();
  }

  private connect(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
    if (this.heardAt === undefined && this.lostSince === undefined)
      this.store.setLink({ kind: "connecting" });
    const socket = new WebSocket(this.url);
    this.socket = socket;
    const opened = performance.now();
    socket.onmessage = (message) => this.receive(message.data);
    socket.onclose = () => this.lost();
    // A peer that accepts and stays silent is as good as none.
    this.timer = setTimeout(() => {
      if (this.socket === socket && (this.heardAt ?? 0) < opened) this.lost();
    }, kSilenceMs * 2);
  }

  private receive(data: unknown): void {
    const frame = parseFrame(data);
    if (frame === undefined) return;
    const now = performance.now();
    this.heardAt = now;
    if (frame.type === "snapshot") this.attempt = 0;
    this.store.apply(frame);
    // Twice a second is enough for the age on the screen.
    if (this.lostSince !== undefined || now - this.lastShown > 450 || frame.type === "snapshot") {
      this.lostSince = undefined;
      this.lastShown = now;
      this.store.setLink({ kind: "live", heardAt: now });
    }
  }

  private watch(): void {
    if (this.heardAt === undefined || this.lostSince !== undefined) return;
    if (performance.now() - this.heardAt > kSilenceMs) this.lost();
  }

  private lost(): void {
    this.drop();
    this.lostSince ??= this.heardAt ?? performance.now();
    this.store.setLink({ kind: "lost", since: this.lostSince, heardAt: this.heardAt });
    clearTimeout(this.timer);
    this.timer = setTimeout(
      () => {
        this.onRetry();
        this.connect();
      },
      retryDelayMs(this.attempt++, Math.random()),
    );
  }

  private drop(): void {
    if (this.socket === undefined) return;
    this.socket.onmessage = null;
    this.socket.onclose = null;
    this.socket.close();
    this.socket = undefined;
  }

  private retryNow = (): void => {
    if (this.lostSince === undefined) return;
    this.drop();
    this.attempt = 0;
    this.connect();
  };

  private markOffline = (): void => this.lost();
}

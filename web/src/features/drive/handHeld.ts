import { ApiProblem, kRequestTimeoutMs } from "@/shared/api";
import type { HandHeldAnswer, HandHeldCommand, Reason } from "@/shared/api/types";
import { isStill, kStill, twistOf, type Direction, type Twist } from "./twist";

/** A drive is repeated so often; the vehicle brakes 0.3 s after the newest one. */
export const kRepeatMs = 50;
/** So often the vehicle is asked how it is while nothing is pressed. */
export const kAskMs = 300;
/** Without an answer for so long the line counts as slow: what is pressed may come too late. */
export const kSlowMs = 400;
const kRetryMs = 500;
/** So long a refusal stays to be read, where nothing is done meanwhile. */
const kReadMs = 2500;
/** More than this on its way stays here: it would only be late. */
const kMostBuffered = 2048;

export interface HandState {
  line: "connecting" | "open" | "cut";
  /** The vehicle does not answer in time. */
  slow: boolean;
  roundTripMs: number | undefined;
  /** This page has the vehicle in hand. */
  mine: boolean;
  /** Whoever has it in hand; empty: somebody beside it. Undefined: nobody. */
  person: string | undefined;
  standing: boolean;
  /** Why the newest command was not done. */
  refused: Reason | undefined;
  /** The dead man's hold is pressed. */
  held: boolean;
  pressed: ReadonlySet<Direction>;
  /** Of the fastest that is possible by hand. */
  share: number;
}

interface Pending {
  atMs: number;
  done?: () => void;
  failed?: (problem: ApiProblem) => void;
}

const kNone: ReadonlySet<Direction> = new Set();

/**
 * The hand-held control of one vehicle: its line, and what is pressed. A direction counts only while the hold is
 * pressed, and only when it was pressed after the hold; whatever goes wrong lets go of both.
 */
export class HandHeld {
  state: HandState;
  private readonly listeners = new Set<() => void>();
  private socket: WebSocket | undefined;
  private timer: ReturnType<typeof setInterval> | undefined;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private sequence = 0;
  private readonly pending = new Map<number, Pending>();
  private driving = false;
  private askedAtMs = -Infinity;
  private heardAtMs = -Infinity;
  private shownAtMs = -Infinity;
  private refusedAtMs = -Infinity;

  constructor(
    private readonly open: () => WebSocket,
    share: number,
    private readonly nowMs: () => number = () => performance.now(),
  ) {
    this.state = {
      line: "connecting",
      slow: false,
      roundTripMs: undefined,
      mine: false,
      person: undefined,
      standing: true,
      refused: undefined,
      held: false,
      pressed: kNone,
      share,
    };
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };

  start(): void {
    this.timer = setInterval(() => this.tick(), kRepeatMs);
    this.connect();
  }

  stop(): void {
    clearInterval(this.timer);
    clearTimeout(this.retry);
    this.drop("line_cut");
  }

  take = (): Promise<void> => this.ask({ do: "take" });
  giveBack = (): Promise<void> => {
    this.release();
    return this.ask({ do: "give_back" });
  };

  /** Pressing the hold anew lets go of every direction: nothing moves because a key was still down. */
  hold(down: boolean): void {
    if (down && !this.state.mine) return;
    this.change({ held: down, pressed: kNone });
    if (!down) this.tick();
  }

  press(direction: Direction, down: boolean): void {
    if (down && !this.state.held) return;
    const pressed = new Set(this.state.pressed);
    if (down) pressed.add(direction);
    else pressed.delete(direction);
    this.change({ pressed });
    // To stand is said at once, to go at the next turn: keys pressed like mad stay below what a line may say.
    if (isStill(this.wanted())) this.tick();
  }

  release(): void {
    if (this.state.held || this.state.pressed.size > 0) this.hold(false);
  }

  setShare(share: number): void {
    this.change({ share });
  }

  /** What it is asked to do now. */
  wanted(): Twist {
    const { mine, held, pressed, share } = this.state;
    return mine && held ? twistOf(pressed, share) : kStill;
  }

  tick(): void {
    if (this.state.line !== "open") return;
    const now = this.nowMs();
    const asked = Math.min(...[...this.pending.values()].map((one) => one.atMs));
    const slow = now - Math.max(asked === Infinity ? now : asked, this.heardAtMs) > kSlowMs;
    if (slow !== this.state.slow) this.change({ slow });
    if (slow) this.release();
    this.giveUp((_, one) => now - one.atMs > kRequestTimeoutMs);
    const twist = this.wanted();
    const still = isStill(twist);
    if (!still || this.driving) this.send({ do: "drive", ...twist, sent_ms: now });
    else if (now - this.askedAtMs >= kAskMs) {
      this.askedAtMs = now;
      this.send({ do: "where" });
    }
    this.driving = !still;
  }

  private connect(): void {
    const socket = this.open();
    this.socket = socket;
    socket.onopen = () => {
      this.heardAtMs = this.nowMs();
      this.change({ line: "open", slow: false, refused: undefined });
      this.tick();
    };
    socket.onmessage = (message) => this.receive(message.data);
    socket.onclose = () => {
      this.drop("line_cut");
      this.retry = setTimeout(() => this.connect(), kRetryMs);
    };
  }

  private drop(why: string): void {
    if (this.socket !== undefined) {
      this.socket.onopen = null;
      this.socket.onmessage = null;
      this.socket.onclose = null;
      this.socket.close();
      this.socket = undefined;
    }
    this.driving = false;
    this.change({
      line: "cut",
      slow: false,
      mine: false,
      held: false,
      pressed: kNone,
      roundTripMs: undefined,
    });
    this.giveUp(() => true, why);
  }

  /** Fails those that no answer comes for any more. */
  private giveUp(isLost: (sequence: number, one: Pending) => boolean, why = "no_answer"): void {
    for (const [sequence, one] of this.pending) {
      if (!isLost(sequence, one)) continue;
      this.pending.delete(sequence);
      one.failed?.(new ApiProblem({ status: 0, code: why }));
    }
  }

  private ask(command: HandHeldCommand): Promise<void> {
    return new Promise((done, failed) => {
      if (!this.send(command, { done, failed })) failed(new ApiProblem({ status: 0, code: "line_cut" }));
    });
  }

  private send(command: HandHeldCommand, answer: Omit<Pending, "atMs"> = {}): boolean {
    const socket = this.socket;
    if (socket === undefined || this.state.line !== "open") return false;
    if (socket.bufferedAmount > kMostBuffered) return false;
    const sequence = ++this.sequence;
    this.pending.set(sequence, { ...answer, atMs: this.nowMs() });
    socket.send(JSON.stringify({ ...command, sequence }));
    return true;
  }

  private receive(data: unknown): void {
    let answer: HandHeldAnswer;
    try {
      answer = JSON.parse(String(data)) as HandHeldAnswer;
    } catch {
      return;
    }
    const now = this.nowMs();
    this.heardAtMs = now;
    const asked = this.pending.get(answer.sequence);
    this.pending.delete(answer.sequence);
    // They come in their order; what nobody asked for says that the vehicle has gone.
    this.giveUp((sequence) => asked === undefined || sequence < answer.sequence);
    const refused = answer.ok ? undefined : { code: answer.reason ?? "refused", params: answer.params ?? {} };
    if (answer.operating_mode !== undefined) {
      const mine = answer.mine === true;
      if (!mine) this.release();
      this.change({ mine, person: answer.person, standing: answer.standing !== false });
    } else if (refused !== undefined) {
      this.change({ mine: false, held: false, pressed: kNone });
    }
    // A command answers for itself.
    if (refused !== undefined && asked?.failed !== undefined)
      asked.failed(new ApiProblem({ status: 409, code: refused.code, params: refused.params }));
    else if (refused !== undefined) {
      this.refusedAtMs = now;
      if (refused.code === "let_go_first") this.release();
      this.change({ refused });
    } else if (this.driving || now - this.refusedAtMs > kReadMs) this.change({ refused: undefined });
    if (answer.ok) asked?.done?.();
    if (asked !== undefined && now - this.shownAtMs > 500) {
      this.shownAtMs = now;
      this.change({ roundTripMs: now - asked.atMs });
    }
  }

  private change(part: Partial<HandState>): void {
    const same = Object.entries(part).every(([key, value]) => this.state[key as keyof HandState] === value);
    if (same) return;
    this.state = { ...this.state, ...part };
    for (const listener of this.listeners) listener();
  }
}

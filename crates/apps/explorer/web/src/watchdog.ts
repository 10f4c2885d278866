/** Notices a server that is there and does not answer: a process that was stopped keeps its connections open. */

import type { Wish } from "./protocol";

/** Wishes that are always answered, and at once. */
const ANSWERED = new Set<Wish["do"]>(["begin", "set", "noise", "kick", "put", "pull", "restart", "start", "advance", "strips", "share", "source", "define"]);

/** A busy machine may take so long (milliseconds) for an answer. */
export const SILENCE = 4000;

export class Watchdog {
  private timer = 0;
  private silent = false;

  /** `tell` hears of silence, and of its end. */
  constructor(private readonly tell: (silent: boolean) => void) {}

  /** Something was said. */
  asked(wish: Wish): void {
    if (ANSWERED.has(wish.do) && !this.timer) this.timer = window.setTimeout(() => this.turn(true), SILENCE);
  }

  /** Something was heard, whatever it was: the server lives. */
  heard(): void {
    this.unset();
    this.turn(false);
  }

  /** There is no connection that could be silent. */
  rest(): void {
    this.unset();
    this.silent = false;
  }

  private unset(): void {
    window.clearTimeout(this.timer);
    this.timer = 0;
  }

  private turn(silent: boolean): void {
    if (this.silent === silent) return;
    this.silent = silent;
    this.tell(silent);
  }
}

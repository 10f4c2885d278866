/** What the hand does to the body, on its way to the server: one wish at a time, so that the hand never runs ahead of it. */

import type { Hand as BodyHand } from "./body/panel";
import type { Wish } from "./protocol";

/** A wish without an answer for so long (milliseconds) holds up no other. */
const PATIENCE = 500;

/** What the hand needs of the page. */
export interface HandHost {
  send(wish: Wish): void;
  speed(): number;
  /** The motion rests while the body is held. */
  rest(held: boolean): void;
  /** The first change of a hand is about to be made. */
  begins(): void;
}

export class Hand implements BodyHand {
  private next: Wish | null = null;
  private asked = -Infinity;
  private moved = false;

  constructor(private readonly host: HandHost) {}

  speed(): number {
    return this.host.speed();
  }

  hold(held: boolean): void {
    this.moved = false;
    this.host.rest(held);
  }

  /** The last wish of a hand goes out at once. */
  wish(wish: Wish, last: boolean): void {
    if (!this.moved) this.host.begins();
    Object.assign(this, { next: wish, moved: true });
    if (last) this.send();
  }

  /** The server has answered: the next wish may follow. */
  answered(): void {
    this.asked = -Infinity;
  }

  /** Sends what waits, unless the wish before is still on its way. */
  flush(now: number): void {
    if (this.next && now - this.asked > PATIENCE) this.send();
  }

  private send(): void {
    const { next } = this;
    Object.assign(this, { next: null, asked: performance.now() });
    if (next) this.host.send(next);
  }
}

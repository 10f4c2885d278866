/** Keeps the address of the page at what the page shows: soon after changes, now and then while the body moves. */

import { write, type Place } from "./address";
import { throttle } from "./dom";

const AFTER_CHANGES = 1000;
const WHILE_MOVING = 3000;

export class Keeper {
  /** Something changed. */
  readonly changed = throttle(AFTER_CHANGES, () => this.write());
  private written = 0;

  /** `place` is `null` while there is nothing worth keeping. */
  constructor(private readonly place: () => Place | null) {
    document.addEventListener("visibilitychange", () => this.write());
  }

  /** The body moves. */
  moving(now: number): void {
    if (now - this.written > WHILE_MOVING) this.write();
  }

  write(): void {
    const place = this.place();
    if (!place) return;
    this.written = performance.now();
    window.history.replaceState(null, "", write(place));
  }

  /** Another place follows in the browser's history; this one stays there as it is now. */
  leave(next: Place): void {
    this.write();
    window.history.pushState(null, "", write(next));
  }

  /** The whole address. */
  link(): string {
    const place = this.place();
    return place ? location.href.replace(/#.*/, "") + write(place) : location.href;
  }
}

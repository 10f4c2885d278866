/** A page that computes for itself: the same messages as those of a server, answered by workers. */

import { hear, type Listener, type Transport } from "../listener";
import type { Wish } from "../protocol";
import { engine, Helpers } from "./helpers";
import type { Note, Order } from "./orders";

/** A session that failed begins again after so many milliseconds. */
const RETRY = 1000;
/** Why it closed, as a server would say it: it failed (RFC 6455, 7.4.1). */
const FAILED = 1011;
/** Fewest and most helpers of the map. */
const MAPPERS = [2, 8];

/** Whether this is the first session of the page: its helpers start at once, those of later sessions when they are needed. */
let first = true;

export class Alone implements Transport {
  readonly longest = Infinity;
  private worker: Worker | null = null;
  private helpers: Helpers | null = null;
  private greeted = false;
  private over = false;

  constructor(private readonly listener: Listener) {
    this.begin();
  }

  send(wish: Wish): void {
    if (this.greeted) this.order({ do: "hear", text: JSON.stringify(wish) });
  }

  end(): void {
    this.over = true;
    this.stop();
  }

  private order(order: Order): void {
    this.worker?.postMessage(order);
  }

  private begin(): void {
    const mappers = Math.min(MAPPERS[1], Math.max(MAPPERS[0], navigator.hardwareConcurrency));
    this.worker = engine((note) => this.hear(note));
    this.order({ do: "begin", mappers });
    this.helpers = new Helpers((text) => this.order({ do: "report", text }));
    // These are needed at once: they start while the first body settles.
    if (first) ["naming", ...Array.from({ length: mappers }, (_, k) => `map${k}`)].forEach((name) => this.helpers?.helper(name));
    first = false;
  }

  private hear(note: Note): void {
    if (this.over) return;
    if (note.is === "fault") return this.fail(note.text);
    if (note.is === "post") return this.helpers?.take(note.text);
    if (!this.greeted) {
      this.greeted = true;
      this.listener.open(true, 0);
    }
    if (note.is === "text") hear(note.text, this.listener);
    else if (note.is === "binary") hear(note.bytes, this.listener);
  }

  private fail(why: string): void {
    console.error(`the computation failed: ${why}`);
    this.stop();
    if (this.over) return;
    this.listener.open(false, FAILED, `The computation failed: ${why}`);
    window.setTimeout(() => this.begin(), RETRY);
  }

  private stop(): void {
    this.worker?.terminate();
    this.worker = null;
    this.helpers?.end();
    this.helpers = null;
    this.greeted = false;
  }
}

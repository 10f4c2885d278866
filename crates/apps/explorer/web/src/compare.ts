/** Compare: one place is held at a time, beside the body. A tracked cell stands there where the model was fitted to one. */

import type { Place } from "./address";
import type { Frame } from "./binary";
import { byId } from "./dom";
import type { Beside } from "./half";
import type { Connect } from "./listener";
import type { Plane } from "./protocol";
import type { Session } from "./session";
import { TrackedView, type Sight } from "./tracked";
import { Twin } from "./twin";
import { trackedBy, unitsOf } from "./units";

/** What is to be held, and what the body looks like. */
export interface Compared {
  now(): { place: Place | null; session: Session | null; plane: Plane | null };
  sight(): Sight | null;
}

export class Compare {
  private beside: Beside | null = null;
  /** The reader does not want to see the tracked cell. */
  private hidden = false;

  /** `connect` finds who computes a place. */
  constructor(private readonly connect: Connect, private readonly compared: Compared) {
    byId("compare").addEventListener("click", () => {
      const { place, session, plane } = compared.now();
      if (place && session) this.hold(place, session, plane);
    });
    byId("twin-end").addEventListener("click", () => {
      const { beside } = this;
      this.hidden ||= beside instanceof TrackedView;
      beside?.end();
      const { session } = compared.now();
      if (session) this.begin(session);
    });
  }

  /** A body begins. If its model was fitted to a tracked cell, the cell is shown in the left half. */
  begin(session: Session): void {
    const wanted = this.hidden ? null : trackedBy(session);
    if (this.beside instanceof TrackedView && this.beside.cell !== wanted) this.beside.end();
    if (wanted && !this.beside) this.beside = new TrackedView(wanted, () => this.compared.sight(), () => (this.beside = null));
  }

  /** Holds a place; what stood there before is let go. */
  private hold(place: Place, session: Session, plane: Plane | null): void {
    const { model, parameters, registry } = session;
    this.beside?.end();
    const names = [...new Set([plane?.x.name ?? "", plane?.y?.name ?? "", ...Object.keys(place.parameters)])];
    this.beside = new Twin(this.connect, { place, model, names, values: { ...parameters }, regimes: registry.regimes, unit: unitsOf(session).length }, () => (this.beside = null));
  }

  draw(seconds: number, moving: boolean): void {
    this.beside?.draw(seconds, moving);
  }

  touch(): void {
    this.beside?.touch();
  }

  /** What stands beside the body. */
  shown(): Frame | null {
    return this.beside?.shown() ?? null;
  }
}

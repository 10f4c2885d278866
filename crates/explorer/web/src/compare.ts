/** Compare: one place is held at a time, beside the body. */

import type { Place } from "./address";
import { byId } from "./dom";
import type { Connect } from "./listener";
import type { Plane } from "./protocol";
import type { Session } from "./session";
import { Twin } from "./twin";

export class Compare {
  private twin: Twin | null = null;

  /** `now` gives what is to be held; `connect` finds who computes it. */
  constructor(private readonly connect: Connect, now: () => { place: Place | null; session: Session | null; plane: Plane | null }) {
    byId("compare").addEventListener("click", () => {
      const { place, session, plane } = now();
      if (place && session) this.hold(place, session, plane);
    });
    byId("twin-end").addEventListener("click", () => this.twin?.end());
  }

  /** Holds a place; what was held before is let go. */
  private hold(place: Place, { model, parameters, registry }: Session, plane: Plane | null): void {
    this.twin?.end();
    const names = [...new Set([plane?.x.name ?? "", plane?.y?.name ?? "", ...Object.keys(place.parameters)])];
    this.twin = new Twin(this.connect, { place, model, names, values: { ...parameters }, regimes: registry.regimes }, () => (this.twin = null));
  }

  draw(seconds: number, moving: boolean): void {
    this.twin?.draw(seconds, moving);
  }

  touch(): void {
    this.twin?.touch();
  }
}

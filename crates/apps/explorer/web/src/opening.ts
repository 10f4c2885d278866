/** Opening a place: the page asks for a body and waits until the server agrees. */

import type { Place } from "./address";
import type { Begin } from "./protocol";
import type { Session } from "./session";
import { toast } from "./toasts";

/** Every body of the page has the same seed: an address says all there is to say. */
export const SEED = 1;

export class Opening {
  /** What was asked for and not yet answered. */
  under: Place | null = null;

  constructor(private readonly send: (begin: Begin) => void) {}

  open(place: Place, session: Session): void {
    const { model, preset, parameters, state, position, t, noise } = place;
    session.choose(model, preset, parameters);
    this.under = place;
    this.send({ do: "begin", model, preset, parameters, state, position, t, noise, seed: SEED });
  }

  /** The server agreed to this place. */
  agreed(): Place | null {
    const place = this.under;
    this.under = null;
    return place;
  }

  /** A beginning that was refused is tried with less: without state, then without changes. */
  refused(why: string, session: Session): void {
    const place = this.agreed();
    toast(why);
    if (place?.state) this.open({ ...place, state: null, position: null, t: 0 }, session);
    else if (place && Object.keys(place.parameters).length) this.open({ ...place, parameters: {} }, session);
  }
}

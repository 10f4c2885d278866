/** The units of the body in sight: those of its cell where the model was fitted to one, else the model's own. */

import { setText } from "./dom";
import type { Tracked } from "./protocol";
import type { Session } from "./session";

/** Units of length and time; `null`: the model's own. */
export interface Units {
  length: string | null;
  time: string | null;
}

/** What the page says of each kind of quantity: with its unit, and with the model's own. */
const WORDS: Record<string, (units: Units) => string> = {
  time: ({ time }) => time ?? "model time",
  "in-time": ({ time }) => (time ? ` (${time})` : ""),
  "behind-time": ({ time }) => behind(time),
  "behind-length": ({ length }) => behind(length),
  rate: ({ time }) => (time ? `1/${time}` : "per model time"),
  turning: ({ time }) => `rad/${time ?? "time"}`,
  length: ({ length }) => length ?? "",
  speed: (units) => ofSpeed(units) ?? "",
};

let now: Units = { length: null, time: null };

/** The units in use. */
export function units(): Units {
  return now;
}

/** The unit of speeds; `null`: the model's own. */
export function ofSpeed({ length, time }: Units): string | null {
  return length && time ? `${length}/${time}` : null;
}

/** A unit behind a number, if there is one. */
export function behind(unit: string | null): string {
  return unit ? ` ${unit}` : "";
}

/** Puts units to use: every element that names one follows. */
export function useUnits(next: Units, root: ParentNode = document): void {
  now = next;
  for (const element of root.querySelectorAll<HTMLElement>("[data-unit]")) setText(element, WORDS[element.dataset.unit ?? ""]?.(now) ?? "");
}

/** The tracked cell that the model of a session was fitted to. */
export function trackedBy({ tracked, model }: Session): Tracked | null {
  return tracked?.model === model.name ? tracked : null;
}

/** The units of a session's model: those of its cell, if it was fitted to one. */
export function unitsOf(session: Session): Units {
  const cell = trackedBy(session);
  return cell ? unitsOfCell(cell) : { length: null, time: null };
}

/** The units of a cell, as they are written. */
export function unitsOfCell({ length, time }: Tracked): Units {
  return { length: length === "um" ? "\u00b5m" : length, time };
}

/** The left half of the body's picture: it shows a place that is held, or a tracked cell. */

import type { Frame } from "./binary";
import { byId } from "./dom";

/** What is shown there. */
export interface Beside {
  /** Draws; `seconds` since the last picture, `moving` whether the page moves. */
  draw(seconds: number, moving: boolean): void;
  touch(): void;
  end(): void;
  /** What it shows. */
  shown(): Frame | null;
}

/** Makes room; the words are those of the picture and of the button that ends it. */
export function showHalf(picture: string, end: string): void {
  byId("body").parentElement?.toggleAttribute("data-compare", true);
  byId("twin-part").hidden = false;
  byId("twin").setAttribute("aria-label", picture);
  const button = byId("twin-end");
  button.title = end;
  button.setAttribute("aria-label", end);
}

export function hideHalf(): void {
  byId("body").parentElement?.toggleAttribute("data-compare", false);
  byId("twin-part").hidden = true;
}

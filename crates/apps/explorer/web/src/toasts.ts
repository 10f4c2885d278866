/** Short notes in a corner: at most three, each for some seconds. */

import { byId, make } from "./dom";

const MOST = 3;
const LIFE = 8000;

/** Shows a note; the same one twice is shown once. */
export function toast(text: string): void {
  const list = byId("toasts");
  for (const old of list.children) if (old.firstChild?.textContent === text) old.remove();
  const close = make("button", { type: "button", "aria-label": "Dismiss", class: "quiet" }, "\u00d7");
  const note = make("li", {}, make("span", {}, text), close);
  close.addEventListener("click", () => note.remove());
  list.append(note);
  while (list.children.length > MOST) list.firstElementChild?.remove();
  window.setTimeout(() => note.remove(), LIFE);
}

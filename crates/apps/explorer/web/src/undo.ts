/** Undo and redo: the places before each change, and those after what was undone. */

import type { Place } from "./address";
import { byId, takesKeys } from "./dom";

/** So many places are kept. */
const MOST = 200;
/** Changes of one kind that follow each other within so many milliseconds are one. */
const TOGETHER = 900;

export class Undo {
  private readonly past: Place[] = [];
  private future: Place[] = [];
  private kind = "";
  private at = -Infinity;
  private readonly buttons = [byId<HTMLButtonElement>("undo"), byId<HTMLButtonElement>("redo")];

  /** `now` gives the present place, `null` while there is none; `restore` takes the page to a place. */
  constructor(
    private readonly now: () => Place | null,
    private readonly restore: (place: Place) => void,
  ) {
    const [undo, redo] = this.buttons;
    undo.addEventListener("click", () => this.back());
    redo.addEventListener("click", () => this.forth());
    document.addEventListener("keydown", (event) => this.key(event));
    this.show();
  }

  /** A change of this kind is about to be made. Changes without a kind are never taken together. */
  note(kind: string, place = this.now()): void {
    const time = performance.now();
    const same = kind !== "" && kind === this.kind && time - this.at < TOGETHER;
    Object.assign(this, { kind, at: time });
    if (same || !place) return;
    this.past.push(place);
    if (this.past.length > MOST) this.past.shift();
    this.future = [];
    this.show();
  }

  private back(): void {
    this.step(this.past, this.future);
  }

  private forth(): void {
    this.step(this.future, this.past);
  }

  private step(from: Place[], to: Place[]): void {
    const [now, place] = [this.now(), from.at(-1)];
    if (!now || !place) return;
    from.pop();
    to.push(now);
    this.kind = "";
    this.restore(place);
    this.show();
  }

  private show(): void {
    [this.past, this.future].forEach((list, k) => (this.buttons[k].disabled = list.length === 0));
  }

  private key(event: KeyboardEvent): void {
    const letter = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || (letter !== "z" && letter !== "y")) return;
    const typing = takesKeys(event.target) && event.target instanceof HTMLElement && event.target.closest("input.number, textarea, dialog");
    if (typing) return;
    event.preventDefault();
    if (letter === "y" || event.shiftKey) this.forth();
    else this.back();
  }
}

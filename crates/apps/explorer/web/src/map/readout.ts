/** The lines below the map: what is known about the cell under the pointer, asked at most fifteen times a second. */

import { byTouch, make, throttle } from "../dom";
import { swatch } from "../glyphs";
import { pretty, typeset } from "../numbers";
import type { Evidence, Parameter, Regime } from "../protocol";
import { symbol } from "../symbols";
import { explained } from "../terms";
import { units } from "../units";

const GAP = 1000 / 15;

export class Readout {
  private cell: [number, number] | null = null;
  private readonly ask: () => void;
  private readonly place = make("span", { class: "readout-place" });
  private readonly verdict = make("span", { class: "readout-verdict" });
  private readonly why = make("span", { class: "readout-why" });
  private regime: string | null | undefined;

  constructor(
    element: HTMLElement,
    private readonly regimes: () => Regime[],
    question: (cell: [number, number]) => void,
  ) {
    const head = make("span", { class: "readout-head" }, this.place, this.verdict);
    element.replaceChildren(make("div", { class: "readout-text" }, head, this.why));
    this.ask = throttle(GAP, () => this.cell && question(this.cell));
    this.leave();
  }

  /** The pointer is upon this cell, whose motion was computed at these values; the answer comes later. */
  point(at: [Parameter, number][], cell: [number, number] | null): void {
    this.place.replaceChildren(
      ...at.map(([parameter, value]) => make("span", {}, symbol(parameter.symbol), ` = ${pretty(value)}`)),
    );
    if (cell && this.cell && cell[0] === this.cell[0] && cell[1] === this.cell[1]) return;
    this.cell = cell;
    if (cell) this.ask();
    else this.show(undefined, "not computed yet");
  }

  /** Another map: its cells are others. */
  renew(): void {
    this.cell = null;
  }

  /** Cells have come: the question again, if it had no answer. */
  wait(): void {
    if (this.cell && !this.regime) this.ask();
  }

  /** The same question again: more may be known by now. */
  refresh(): void {
    if (this.cell) this.ask();
  }

  /** The pointer left. */
  leave(): void {
    this.cell = null;
    this.place.replaceChildren();
    const how = byTouch()
      ? "Tap the map for the evidence and to set the parameters of the body; drag to pan, two fingers to zoom."
      : "Point at the map for the evidence; click to set the parameters of the body; drag to pan, wheel to zoom.";
    this.show(undefined, how);
  }

  answer(evidence: Evidence): void {
    if (!this.cell || evidence.cell[0] !== this.cell[0] || evidence.cell[1] !== this.cell[1]) return;
    this.show(evidence.regime, evidence.regime === null ? evidence.why || "not computed yet" : typeset(evidence.why, units().time));
  }

  private show(name: string | null | undefined, why: string): void {
    if (name !== this.regime) {
      const regime = this.regimes().find((one) => one.name === name);
      this.verdict.replaceChildren(...(regime ? [swatch(regime, 14), make("b", {}, regime.words)] : []));
      this.regime = name;
    }
    explained(this.why, why);
  }
}

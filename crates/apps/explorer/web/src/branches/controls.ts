/** The controls of the branches: which side of the panel is shown, along which parameter, what is drawn, start and stop, progress. */

import { byId, setText } from "../dom";
import { typeset } from "../numbers";
import type { Parameter } from "../protocol";
import { symbolOption } from "../symbols";
import type { Ordinate } from "./set";

export interface BranchActions {
  follow(along: string): void;
  stop(): void;
  /** Another number is to be drawn. */
  show(): void;
  /** The map or the branches are shown now. */
  turned(): void;
}

const EXPLAINED = "A branch is the same motion at neighbouring values of a parameter, stable or not. Follow finds the motion that the body settles on and follows it across the map, with what begins on it.";

export class BranchControls {
  private readonly side = byId<HTMLSelectElement>("branch-along");
  private readonly shown = byId<HTMLSelectElement>("branch-ordinate");
  private readonly button = byId<HTMLButtonElement>("branch-follow");
  private readonly note = byId("branch-empty");
  private under = false;
  private why = "";

  constructor(private readonly actions: BranchActions) {
    this.button.addEventListener("click", () => (this.under ? actions.stop() : actions.follow(this.side.value)));
    this.shown.addEventListener("change", () => actions.show());
    for (const tab of ["map", "branches"]) byId(`show-${tab}`).addEventListener("click", () => this.turn(tab));
  }

  ordinate(): Ordinate {
    return this.shown.value === "period" ? "period" : "speed";
  }

  /** The parameters that branches may be followed along. */
  offer(sides: Parameter[]): void {
    const before = this.side.value;
    if (sides.map((one) => one.name).join() === [...this.side.options].map((one) => one.value).join()) return;
    this.side.replaceChildren(...sides.map(symbolOption));
    if (sides.some((one) => one.name === before)) this.side.value = before;
  }

  progress(done: number, text: string): void {
    this.state(true, text, done);
    this.why = "";
  }

  rest(text: string): void {
    this.state(false, text, text ? 1 : 0);
    this.why = "";
  }

  fail(why: string): void {
    this.state(false, "", 0);
    this.why = why;
    this.explain(true);
  }

  /** What is said where there is nothing to draw. */
  explain(empty: boolean): void {
    this.note.hidden = !empty;
    setText(this.note, this.why ? `Not followed: ${typeset(this.why)}` : this.under ? "" : EXPLAINED);
  }

  private state(under: boolean, text: string, done: number): void {
    this.under = under;
    setText(this.button, under ? "Stop" : "Follow");
    setText(byId("branch-progress-text"), text);
    byId<HTMLProgressElement>("branch-progress-bar").value = done;
  }

  private turn(tab: string): void {
    byId("map-panel").dataset.tab = tab;
    for (const one of ["map", "branches"]) byId(`show-${one}`).setAttribute("aria-pressed", String(one === tab));
    this.actions.turned();
  }
}

/** The tour: a panel with one step at a time, and a mark at the thing to try. */

import { byId, setText } from "../dom";
import { STEPS } from "./steps";

export class Tour {
  /** The step that is shown, from 1; `null` without a tour. */
  step: number | null = null;
  private readonly panel = byId("tour");

  /** `go` opens the address of a step; `changed` hears of every change. */
  constructor(
    private readonly go: (hash: string) => void,
    private readonly changed: () => void,
  ) {
    byId("tour-open").addEventListener("click", () => this.begin(1));
    byId("tour-next").addEventListener("click", () => this.next());
    byId("tour-back").addEventListener("click", () => this.begin((this.step ?? 2) - 1));
    byId("tour-end").addEventListener("click", () => this.end());
    this.panel.addEventListener("keydown", (event) => event.key === "Escape" && this.end());
  }

  /** The place of a step, for an address that names only the step. */
  static place(step: number): string {
    return STEPS[step - 1].place;
  }

  static get length(): number {
    return STEPS.length;
  }

  private next(): void {
    if (this.step === STEPS.length) this.end();
    else this.begin((this.step ?? 0) + 1);
  }

  /** Goes to the place of a step. */
  private begin(step: number): void {
    this.go(`${Tour.place(step)}&tour=${step}`); // the place that is left keeps its own step
    this.show(step);
    byId("tour-title").focus();
  }

  /** Shows a step without going to its place; `null`: none. */
  show(step: number | null): void {
    this.step = step;
    this.panel.hidden = step === null;
    document.querySelector("[data-tour-target]")?.removeAttribute("data-tour-target");
    if (step === null) return;
    const { title, seen, todo } = STEPS[step - 1];
    setText(byId("tour-count"), `Step ${step} of ${STEPS.length}`);
    setText(byId("tour-title"), title);
    setText(byId("tour-seen"), seen);
    setText(byId("tour-todo"), todo);
    byId<HTMLButtonElement>("tour-back").disabled = step === 1;
    setText(byId("tour-next"), step === STEPS.length ? "Finish" : "Next");
    this.mark();
  }

  /** Marks the thing to try, once it stands on the page. */
  mark(): void {
    if (this.step !== null) document.querySelector(STEPS[this.step - 1].target)?.setAttribute("data-tour-target", "");
  }

  private end(): void {
    this.show(null);
    byId("tour-open").focus();
    this.changed();
  }
}

/** Work that gives way to the first picture of a new body. */

/** Where no picture comes within so many milliseconds, the work is done all the same. */
const PATIENCE = 250;

export class Later {
  private work: (() => void) | null = null;
  private timer = 0;

  /** Whether work waits. */
  get due(): boolean {
    return this.work !== null;
  }

  /** Work to do after the next picture; what waited before is forgotten. */
  put(work: () => void): void {
    this.work = work;
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.settle(), PATIENCE);
  }

  /** The picture is drawn: the work follows once it is on the screen. */
  go(): void {
    if (!this.work) return;
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.settle());
  }

  private settle(): void {
    const { work } = this;
    this.work = null;
    work?.();
  }
}

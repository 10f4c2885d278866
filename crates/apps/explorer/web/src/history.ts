/** What the body did lately: a ring of samples, shared by the trail and the time series. */

import type { Frame } from "./binary";

export const T = 0;
export const X = 1;
export const Y = 2;
export const SPEED = 3;
export const TURNING = 4;
/** The first observable. */
export const SHAPE = 5;

const CAPACITY = 16384;

export class History {
  columns = SHAPE;
  length = 0;
  /** Samples taken since the run began, those forgotten included. */
  total = 0;
  private next = 0;
  private data = new Float64Array(CAPACITY * SHAPE);

  clear(): void {
    this.length = this.total = this.next = 0;
  }

  /** Appends the samples of a frame. Where time ran backwards a new run has begun: what was before is forgotten. */
  take(frame: Frame): void {
    if (frame.columns !== this.columns && frame.rows.length) this.widen(frame.columns);
    if (this.length && frame.t < this.at(this.length - 1, T) - 1e-9) this.clear();
    for (let from = 0; from < frame.rows.length; from += this.columns) {
      for (let c = 0; c < this.columns; c++) this.data[this.next * this.columns + c] = frame.rows[from + c];
      this.next = (this.next + 1) % CAPACITY;
      this.total++;
      if (this.length < CAPACITY) this.length++;
    }
  }

  /** The value of sample `index`, counted from the oldest. */
  at(index: number, column: number): number {
    return this.data[((this.next - this.length + index + CAPACITY) % CAPACITY) * this.columns + column];
  }

  /**
   * The first sample from `from` on to draw where only every `stride`-th is drawn. Strides are counted from the beginning
   * of the run, so that a line keeps its corners while its window moves on.
   */
  start(from: number, stride: number): number {
    const absolute = this.total - this.length + from;
    return from + ((stride - (absolute % stride)) % stride);
  }

  /** The first sample not before time `t`. */
  since(t: number): number {
    let [low, high] = [0, this.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.at(middle, T) < t) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  private widen(columns: number): void {
    this.columns = columns;
    this.data = new Float64Array(CAPACITY * columns);
    this.clear();
  }
}

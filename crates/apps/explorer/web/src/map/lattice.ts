/** The cells of one map: their regimes, and a picture of one pixel per cell. */

import type { Cells } from "../binary";
import type { Grid, MapStart, Regime } from "../protocol";
import { pixelX, pixelY, type Box, type View } from "../plot";

/** A cell that no verdict covers yet. */
export const UNKNOWN = 255;

/** Bytes of a cell in a message. */
const SIZE = 16;

/** Opacity of cells that only a coarser look speaks for. */
const PALE = 130;

const POINT: Grid = { name: "", first: 0, step: 1, count: 1 };

export class Lattice {
  readonly columns: number;
  readonly rows: number;
  /** Regime of each cell, row by row from the lowest y. */
  readonly regimes: Uint8Array;
  /** Largest Lyapunov exponent of each cell and the half width of its 95 % interval; NaN where there is none, or none yet. */
  readonly exponents: Float32Array;
  readonly errors: Float32Array;
  /** How coarse the look is that each cell has its regime from. */
  private readonly levels: Uint8Array;
  private readonly x: Grid;
  private readonly y: Grid;
  private readonly image: ImageData;
  private readonly pixels: Uint32Array;
  private readonly canvas: HTMLCanvasElement;
  private readonly colours: Uint32Array;
  private readonly pale: Uint32Array;
  private stale = false;

  constructor(
    readonly start: MapStart,
    private readonly legend: Regime[],
  ) {
    this.x = start.x;
    this.y = start.y ?? POINT;
    this.columns = this.x.count;
    this.rows = this.y.count;
    this.regimes = new Uint8Array(this.columns * this.rows).fill(UNKNOWN);
    this.exponents = new Float32Array(this.regimes.length).fill(NaN);
    this.errors = new Float32Array(this.regimes.length).fill(NaN);
    this.levels = new Uint8Array(this.regimes.length).fill(UNKNOWN);
    this.image = new ImageData(this.columns, this.rows);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.canvas = document.createElement("canvas");
    this.canvas.width = this.columns;
    this.canvas.height = this.rows;
    this.colours = Uint32Array.from(legend, (regime) => pixel(regime.area, 255));
    this.pale = Uint32Array.from(legend, (regime) => pixel(regime.area, PALE));
  }

  /**
   * Enters cells. One of level l stands for the 2^l x 2^l cells about it, but not for those that a finer look has reached:
   * a coarse verdict that took long arrives late.
   */
  take({ count, view }: Cells): void {
    for (let k = 0; k < count && SIZE * (k + 1) <= view.byteLength; k++) {
      const at = SIZE * k;
      const [i, j] = [view.getUint16(at, true), view.getUint16(at + 2, true)];
      const [level, regime] = [view.getUint8(at + 4), view.getUint8(at + 5)];
      this.fill(i, j, level, regime);
      this.fill(i, j, 0, regime);
      if (i >= this.columns || j >= this.rows) continue;
      this.exponents[i + this.columns * j] = view.getFloat32(at + 8, true);
      this.errors[i + this.columns * j] = view.getFloat32(at + 12, true);
    }
    this.stale = true;
  }

  private fill(i: number, j: number, level: number, regime: number): void {
    const size = 1 << level;
    const [left, lowest] = [i - (size >> 1), j - (size >> 1)];
    for (let row = Math.max(0, lowest); row < Math.min(this.rows, lowest + size); row++) {
      for (let column = Math.max(0, left); column < Math.min(this.columns, left + size); column++) {
        const at = row * this.columns + column;
        if (this.levels[at] < level) continue;
        this.levels[at] = level;
        this.regimes[at] = regime;
        // A first look that stands for others is pale.
        const colour = (level ? this.pale : this.colours)[regime] ?? 0;
        this.pixels[(this.rows - 1 - row) * this.columns + column] = colour;
      }
    }
  }

  /** The cell about a point of the plane; `null` outside. */
  cell(x: number, y: number): [number, number] | null {
    const i = Math.round((x - this.x.first) / this.x.step);
    const j = this.start.y ? Math.round((y - this.y.first) / this.y.step) : 0;
    return i >= 0 && i < this.columns && j >= 0 && j < this.rows ? [i, j] : null;
  }

  /** The values at the centre of a cell, where its motion was computed. */
  centre([i, j]: [number, number]): [number, number] {
    return [this.x.first + i * this.x.step, this.y.first + j * this.y.step];
  }

  /** The regime of a cell that has a verdict of its own; `null` where only a coarser look speaks for it. */
  verdict([i, j]: [number, number]): Regime | null {
    const at = j * this.columns + i;
    return this.levels[at] === 0 ? (this.legend[this.regimes[at]] ?? null) : null;
  }

  /** Which regimes occur, in the order of legends. */
  occurring(): number[] {
    const seen = new Set(this.regimes);
    return this.legend.map((_, index) => index).filter((index) => seen.has(index));
  }

  /** The rectangle that cells `i` to `end` of row `j` cover on the screen. */
  place(box: Box, view: View, i: number, end: number, j: number): [number, number, number, number] {
    const left = pixelX(box, view, this.x.first + (i - 0.5) * this.x.step);
    const right = pixelX(box, view, this.x.first + (end - 0.5) * this.x.step);
    if (!this.start.y) return [left, box.top, right - left, box.height];
    const top = pixelY(box, view, this.y.first + (j + 0.5) * this.y.step);
    const bottom = pixelY(box, view, this.y.first + (j - 0.5) * this.y.step);
    return [left, top, right - left, bottom - top];
  }

  /** Draws the cells; those that are not known yet stay transparent. */
  draw(g: CanvasRenderingContext2D, box: Box, view: View): void {
    if (this.stale) this.canvas.getContext("2d")?.putImageData(this.image, 0, 0);
    this.stale = false;
    const [left, top, width] = this.place(box, view, 0, this.columns, this.rows - 1);
    const [, lowest, , height] = this.place(box, view, 0, 1, 0);
    g.imageSmoothingEnabled = false;
    g.drawImage(this.canvas, left, top, width, lowest + height - top);
  }

  /** Runs of cells of one regime along the rows, as one path. */
  outlineOf(regime: number, box: Box, view: View): Path2D | null {
    const path = new Path2D();
    let any = false;
    for (let j = 0; j < this.rows; j++) {
      for (let i = 0; i < this.columns; i++) {
        if (this.regimes[j * this.columns + i] !== regime) continue;
        const from = i;
        while (i < this.columns && this.regimes[j * this.columns + i] === regime) i++;
        path.rect(...this.place(box, view, from, i, j));
        any = true;
      }
    }
    return any ? path : null;
  }
}

/** `#rrggbb` as a pixel of ImageData, with this opacity. */
function pixel(colour: string, opacity: number): number {
  const value = parseInt(colour.slice(1), 16);
  return (opacity << 24 | (value & 255) << 16 | (value & 0xff00) | value >> 16) >>> 0;
}

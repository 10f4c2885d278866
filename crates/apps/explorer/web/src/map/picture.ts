/** What the map shows: the cells of now, those of before underneath, and when it must be drawn again. */

import type { Cells } from "../binary";
import { Sheet } from "../canvas";
import { leftRoom, type Box, type View } from "../plot";
import type { MapStart, Regime } from "../protocol";
import { currentInks } from "../theme";
import { divided, rangeOf } from "./exponents";
import { landmarks, type Landmark } from "./landmarks";
import { Lattice } from "./lattice";
import { paint, paintCells, type Areas, type Memory } from "./painting";
import type { Sides } from "./pick";

/** Smaller than this (CSS pixels) there is no room for axes. */
const LEAST = 80;

export class MapPicture {
  lattice: Lattice | null = null;
  private readonly sheet: Sheet;
  private memory: Memory | null = null;
  private marks: Landmark[] = [];
  private outdated = false;
  private dirty = true;
  /** Room left of the frame, for long numbers more. */
  private left = 62;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly regimes: () => Regime[],
    /** Draws more upon the areas. */
    private readonly more: (g: CanvasRenderingContext2D, box: Box, view: View) => void,
    /** The height of what lies between a strip and its exponents. */
    private readonly lanes: () => number,
  ) {
    this.sheet = new Sheet(canvas, () => (this.dirty = true));
  }

  /** Draws again before the next picture on the screen. */
  touch(): void {
    this.dirty = true;
  }

  /** Other axes: nothing of what was shown holds. */
  forget(): void {
    this.lattice = this.memory = null;
    this.marks = [];
    this.dirty = true;
  }

  /** Other parameters off the axes: what is shown pales when the new map begins. */
  age(): void {
    this.outdated = true;
  }

  /** Whether what is shown belongs to other parameters than the present ones. */
  get aged(): boolean {
    return this.outdated;
  }

  start(start: MapStart, view: View): void {
    this.remember(view, start.y === null);
    this.lattice = new Lattice(start, this.regimes());
    this.marks = [];
    this.outdated = false;
    this.dirty = true;
  }

  take(cells: Cells): void {
    this.lattice?.take(cells);
    this.dirty = true;
  }

  /** All cells are there. */
  finish(): void {
    this.memory = null;
    if (this.lattice) this.marks = landmarks(this.lattice);
    this.dirty = true;
  }

  /** The frame of the data. */
  box(): Box {
    const { left } = this;
    return { left, top: 8, width: this.sheet.width - left - 12, height: this.sheet.height - 8 - 42 };
  }

  /** Draws where something changed. */
  draw(view: View, sides: Sides, mark: { x: number; y: number }): void {
    if (!this.dirty || this.sheet.width < LEAST) return;
    this.dirty = false;
    this.sheet.clear();
    const lanes = this.lanes();
    const labels = { x: { name: sides.x.symbol }, y: sides.y && { name: sides.y.symbol } };
    this.left = sides.y ? leftRoom(this.sheet.g, this.box(), view) : leftRoom(this.sheet.g, divided(this.box(), lanes).above, rangeOf(this.lattice, view));
    paint(this.sheet.g, { ...this.areas(this.box(), view), labels, mark, landmarks: this.marks, lanes }, currentInks());
    this.more(this.sheet.g, this.box(), view);
  }

  private areas(box: Box, view: View): Areas {
    return { box, view, regimes: this.regimes(), lattice: this.lattice, memory: this.memory };
  }

  /** Keeps the areas in sight as a picture, until the new map covers them. */
  private remember(view: View, strip: boolean): void {
    if (!this.lattice || this.sheet.width < LEAST) return;
    const box = { ...(strip ? divided(this.box(), 0).strip : this.box()), left: 0, top: 0 };
    const picture = document.createElement("canvas");
    picture.width = Math.max(1, Math.round(box.width));
    picture.height = Math.max(1, Math.round(box.height));
    const g = picture.getContext("2d");
    if (g) paintCells(g, this.areas(box, view), 1, currentInks());
    this.memory = { picture, view, outdated: this.outdated || (this.memory?.outdated ?? false) };
  }
}

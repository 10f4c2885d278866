/** The bifurcation diagram: a number of every motion against the parameter. */

import { Sheet } from "../canvas";
import { pretty, type Ticks } from "../numbers";
import { drawAxes, leftRoom, pixelX, pixelY, type Box, type View } from "../plot";
import type { Parameter, Regime, SpecialPoint } from "../protocol";
import { currentInks, type Inks } from "../theme";
import { ofSpeed, units } from "../units";
import { colourOf, paintBranches, paintSelected, paintSpecials } from "./painting";
import { isSpecial, type BranchSet, type Ordinate, type Spot } from "./set";

/** What a diagram shows. */
export interface DiagramScene {
  set: BranchSet;
  ordinate: Ordinate;
  parameter: Parameter;
  /** The value of the body's parameter. */
  now: number;
  selected: Spot | null;
  regimes: Regime[];
}

/** Room about the branches, as a part of the range. */
const ROOM = { x: 0.02, y: 0.07 };
const LEAST = 80;

export class Diagram {
  private readonly sheet: Sheet;
  private dirty = true;
  /** Room left of the frame, for long numbers more. */
  private left = 62;
  private scene: DiagramScene | null = null;
  private view: View | null = null;

  constructor(canvas: HTMLCanvasElement) {
    this.sheet = new Sheet(canvas, () => (this.dirty = true));
  }

  touch(): void {
    this.dirty = true;
  }

  /** Shows this when it is drawn next. */
  show(scene: DiagramScene | null): void {
    this.scene = scene;
    this.view = scene && viewOf(scene);
    this.dirty = true;
  }

  draw(): void {
    const { scene, view, sheet } = this;
    if (!this.dirty || sheet.width < LEAST) return;
    this.dirty = false;
    sheet.clear();
    if (scene && view) this.left = leftRoom(sheet.g, this.box(), view, isLog(scene.ordinate) ? logTicks(view) : undefined);
    if (scene && view) paint(sheet.g, scene, this.box(), view, currentInks());
  }

  box(): Box {
    const { left } = this;
    return { left, top: 8, width: this.sheet.width - left - 12, height: this.sheet.height - 8 - 42 };
  }

  /** Where a point is on the canvas. */
  place(spot: Spot | SpecialPoint): [number, number] | null {
    const { scene, view } = this;
    return scene && view && placed(scene, this.box(), view, spot);
  }
}

const isLog = (ordinate: Ordinate): boolean => ordinate === "period";
const scaled = (ordinate: Ordinate, value: number): number => (isLog(ordinate) ? Math.log10(value) : value);

function placed({ set, ordinate }: DiagramScene, box: Box, view: View, spot: Spot | SpecialPoint): [number, number] | null {
  const at = isSpecial(spot) ? set.markAt(spot, ordinate) : set.at(spot, ordinate);
  return at && [pixelX(box, view, at[0]), pixelY(box, view, scaled(ordinate, at[1]))];
}

/** The range followed, and that of all values. */
function viewOf({ set, ordinate }: DiagramScene): View {
  const { low, high } = set.start.along;
  const values = set.branches.flatMap((_, branch) => set.pieces(branch, ordinate).flatMap((piece) => piece.points.map((at) => scaled(ordinate, at[1]))));
  let [y0, y1] = [Infinity, -Infinity];
  for (const value of values) [y0, y1] = [Math.min(y0, value), Math.max(y1, value)];
  if (!values.length) [y0, y1] = [0, 1];
  const room = { x: ROOM.x * (high - low), y: Math.max(ROOM.y * (y1 - y0), 1e-3 * Math.max(Math.abs(y0), Math.abs(y1))) || 1 };
  return { x0: low - room.x, x1: high + room.x, y0: y0 - room.y, y1: y1 + room.y };
}

function paint(g: CanvasRenderingContext2D, scene: DiagramScene, box: Box, view: View, inks: Inks): void {
  const { set, ordinate, parameter, now, selected, regimes } = scene;
  g.fillStyle = inks.plot;
  g.fillRect(box.left, box.top, box.width, box.height);
  g.save();
  g.beginPath();
  g.rect(box.left, box.top, box.width, box.height);
  g.clip();
  paintNow(g, box, pixelX(box, view, now), inks);
  const toPixel = (_: number, [x, y]: [number, number]): [number, number] => [pixelX(box, view, x), pixelY(box, view, scaled(ordinate, y))];
  paintBranches(g, set, ordinate, toPixel, colourOf(regimes), null);
  const place = (spot: Spot | SpecialPoint): [number, number] | null => placed(scene, box, view, spot);
  paintSpecials(g, set, place, inks.ink, inks.plot);
  const at = selected && place(selected);
  if (at) paintSelected(g, at, inks.ink, inks.plot);
  g.restore();
  const label = isLog(ordinate) ? { name: "period", unit: units().time ?? "time" } : { name: "mean speed", unit: ofSpeed(units()) };
  drawAxes(g, box, view, { x: { name: parameter.symbol }, y: label }, inks, isLog(ordinate) ? logTicks(view) : undefined);
}

/** The value of the body's parameter. */
function paintNow(g: CanvasRenderingContext2D, box: Box, x: number, inks: Inks): void {
  g.strokeStyle = inks.muted;
  g.lineWidth = 1;
  g.beginPath();
  g.moveTo(Math.round(x) + 0.5, box.top);
  g.lineTo(Math.round(x) + 0.5, box.top + box.height);
  g.stroke();
}

/** 1, 2 and 5 times powers of ten, in logarithms. */
function logTicks({ y0, y1 }: View): Ticks {
  const out: Ticks = { values: [], labels: [], power: 0 };
  for (let power = Math.floor(y0); power <= y1; power++) {
    for (const digit of [1, 2, 5]) {
      const value = digit * 10 ** power;
      if (Math.log10(value) < y0 || Math.log10(value) > y1) continue;
      out.values.push(Math.log10(value));
      out.labels.push(pretty(value, 3));
    }
  }
  return out;
}

/** Axes around a rectangle of data, for the map and the return map. */

import { scaledLabel, ticks, type Ticks } from "./numbers";
import { drawSymbol, fittedSymbol } from "./symbols";
import type { Inks } from "./theme";

/** A rectangle in CSS pixels. */
export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** What part of the data a rectangle shows; `y0` is at its lower edge. */
export interface View {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

/** The name of an axis, as markup, its unit, if it has one, and what is taken at the right of its line. */
export interface AxisLabel {
  name: string;
  unit?: string | null;
  taken?: number;
}

export const UI_FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';

export const pixelX = (box: Box, view: View, x: number): number => box.left + ((x - view.x0) / (view.x1 - view.x0)) * box.width;
export const pixelY = (box: Box, view: View, y: number): number => box.top + ((view.y1 - y) / (view.y1 - view.y0)) * box.height;
export const dataX = (box: Box, view: View, x: number): number => view.x0 + ((x - box.left) / box.width) * (view.x1 - view.x0);
export const dataY = (box: Box, view: View, y: number): number => view.y1 - ((y - box.top) / box.height) * (view.y1 - view.y0);

/** Frame, ticks outside, numbers, labels; an axis without a label is left out. Ticks upwards may be given. */
export function drawAxes(g: CanvasRenderingContext2D, box: Box, view: View, labels: { x: AxisLabel | null; y: AxisLabel | null }, inks: Inks, up?: Ticks): void {
  g.strokeStyle = inks.muted;
  g.fillStyle = inks.ink;
  g.lineWidth = 1;
  g.strokeRect(Math.round(box.left) - 0.5, Math.round(box.top) - 0.5, Math.round(box.width) + 1, Math.round(box.height) + 1);
  if (labels.x !== null) xAxis(g, box, view, labels.x);
  if (labels.y !== null) yAxis(g, box, view, labels.y, up ?? upward(box, view));
}

const FONT = `11px ${UI_FONT}`;
/** Size of the names of axes, and what is left free at the edge of the sheet. */
const TITLE = 15;
const MARGIN = 3;
/** Pixels between numbers across. */
const BESIDE = 12;
/** Pixels between the numbers of an upward axis. */
const RISE = 40;
/** Least room left of a frame; and what its title takes beside the numbers. */
const LEAST_ROOM = 62;
const TITLE_ROOM = 32;

/** Ticks of an upward axis. */
function upward(box: Pick<Box, "height">, { y0, y1 }: Pick<View, "y0" | "y1">): Ticks {
  return ticks(y0, y1, Math.max(2, box.height / RISE));
}

/** The room that numbers and title of an upward axis take, left of the frame. */
export function leftRoom(g: CanvasRenderingContext2D, box: Pick<Box, "height">, view: Pick<View, "y0" | "y1">, up: Ticks = upward(box, view)): number {
  return Math.max(LEAST_ROOM, Math.ceil(widest(g, up.labels)) + TITLE_ROOM);
}

function widest(g: CanvasRenderingContext2D, labels: string[]): number {
  g.font = FONT;
  return Math.max(0, ...labels.map((text) => g.measureText(text).width));
}

/** Ticks across, so many that their numbers do not touch. */
function across(g: CanvasRenderingContext2D, box: Box, view: View): Ticks {
  const [range, least] = [view.x1 - view.x0, 2];
  const touch = ({ values, labels }: Ticks): boolean => values.length > 1 && ((values[1] - values[0]) / range) * box.width < widest(g, labels) + BESIDE;
  let count = Math.max(least, box.width / 52);
  let found = ticks(view.x0, view.x1, count);
  while (count > least && touch(found)) {
    count -= 1;
    found = ticks(view.x0, view.x1, Math.max(least, count));
  }
  return touch(found) ? thinned(found) : found;
}

/** Every other number only. */
function thinned({ values, labels, power }: Ticks): Ticks {
  return { values, labels: labels.map((label, i) => (i % 2 ? "" : label)), power };
}

function xAxis(g: CanvasRenderingContext2D, box: Box, view: View, { name, unit = null, taken = 0 }: AxisLabel): void {
  const { values, labels, power } = across(g, box, view);
  const bottom = Math.round(box.top + box.height) + 0.5;
  const edge = g.canvas.width / g.getTransform().a;
  g.font = FONT;
  g.textAlign = "center";
  g.textBaseline = "alphabetic";
  g.beginPath();
  values.forEach((value, i) => {
    const x = Math.round(pixelX(box, view, value)) + 0.5;
    g.moveTo(x, bottom);
    g.lineTo(x, bottom + 4);
    // The last number stays on the sheet.
    g.fillText(labels[i], Math.min(x, edge - 2 - g.measureText(labels[i]).width / 2), bottom + 15);
  });
  g.stroke();
  const free = edge - taken;
  const { markup, size, width } = fittedSymbol(scaledLabel(name, unit, power), TITLE, free - 2 * MARGIN);
  drawSymbol(g, markup, within(box.left + box.width / 2, width, free), bottom + 31, size);
}

function yAxis(g: CanvasRenderingContext2D, box: Box, view: View, { name, unit = null }: AxisLabel, { values, labels, power }: Ticks): void {
  const left = Math.round(box.left) - 0.5;
  g.font = FONT;
  g.textAlign = "right";
  g.textBaseline = "middle";
  g.beginPath();
  values.forEach((value, i) => {
    const y = Math.round(pixelY(box, view, value)) + 0.5;
    g.moveTo(left, y);
    g.lineTo(left - 4, y);
    g.fillText(labels[i], left - 7, y + 0.5);
  });
  g.stroke();
  g.textBaseline = "alphabetic";
  const title = left - widest(g, labels) - 15;
  const sheet = g.canvas.height / g.getTransform().a;
  const { markup, size, width } = fittedSymbol(scaledLabel(name, unit, power), TITLE, sheet - 2 * MARGIN);
  g.save();
  g.translate(title, within(box.top + box.height / 2, width, sheet));
  g.rotate(-Math.PI / 2);
  drawSymbol(g, markup, 0, 0, size);
  g.restore();
}

/** The place nearest to `centre` at which so wide a text lies on the sheet. */
function within(centre: number, width: number, sheet: number): number {
  return Math.max(MARGIN + width / 2, Math.min(sheet - MARGIN - width / 2, centre));
}

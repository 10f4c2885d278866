/** Axes around a rectangle of data, for the map and the return map. */

import { ticks, type Ticks } from "./numbers";
import { drawSymbol } from "./symbols";
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

export const UI_FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';

export const pixelX = (box: Box, view: View, x: number): number => box.left + ((x - view.x0) / (view.x1 - view.x0)) * box.width;
export const pixelY = (box: Box, view: View, y: number): number => box.top + ((view.y1 - y) / (view.y1 - view.y0)) * box.height;
export const dataX = (box: Box, view: View, x: number): number => view.x0 + ((x - box.left) / box.width) * (view.x1 - view.x0);
export const dataY = (box: Box, view: View, y: number): number => view.y1 - ((y - box.top) / box.height) * (view.y1 - view.y0);

/** Frame, ticks outside, numbers, labels in markup; an axis without a label is left out. Ticks upwards may be given. */
export function drawAxes(g: CanvasRenderingContext2D, box: Box, view: View, labels: { x: string | null; y: string | null }, inks: Inks, up?: Ticks): void {
  g.strokeStyle = inks.muted;
  g.fillStyle = inks.ink;
  g.lineWidth = 1;
  g.strokeRect(Math.round(box.left) - 0.5, Math.round(box.top) - 0.5, Math.round(box.width) + 1, Math.round(box.height) + 1);
  if (labels.x !== null) xAxis(g, box, view, labels.x);
  if (labels.y !== null) yAxis(g, box, view, labels.y, up ?? upward(box, view));
}

const FONT = `11px ${UI_FONT}`;
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
  let count = Math.max(2, box.width / 52);
  let found = ticks(view.x0, view.x1, count);
  while (count > 2 && found.values.length > 1 && (widest(g, found.labels) + 8) * found.values.length > box.width + 30) {
    count -= 1;
    found = ticks(view.x0, view.x1, count);
  }
  return found;
}

function xAxis(g: CanvasRenderingContext2D, box: Box, view: View, label: string): void {
  const { values, labels } = across(g, box, view);
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
  drawSymbol(g, label, box.left + box.width / 2, bottom + 31, 15);
}

function yAxis(g: CanvasRenderingContext2D, box: Box, view: View, label: string, { values, labels }: Ticks): void {
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
  g.save();
  g.translate(title, box.top + box.height / 2);
  g.rotate(-Math.PI / 2);
  drawSymbol(g, label, 0, 0, 15);
  g.restore();
}

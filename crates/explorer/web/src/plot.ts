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
  if (labels.y !== null) yAxis(g, box, view, labels.y, up ?? ticks(view.y0, view.y1, Math.max(2, box.height / 40)));
}

function xAxis(g: CanvasRenderingContext2D, box: Box, view: View, label: string): void {
  const { values, labels } = ticks(view.x0, view.x1, Math.max(2, box.width / 52));
  const bottom = Math.round(box.top + box.height) + 0.5;
  g.font = `11px ${UI_FONT}`;
  g.textAlign = "center";
  g.textBaseline = "alphabetic";
  g.beginPath();
  values.forEach((value, i) => {
    const x = Math.round(pixelX(box, view, value)) + 0.5;
    g.moveTo(x, bottom);
    g.lineTo(x, bottom + 4);
    g.fillText(labels[i], x, bottom + 15);
  });
  g.stroke();
  drawSymbol(g, label, box.left + box.width / 2, bottom + 31, 15);
}

function yAxis(g: CanvasRenderingContext2D, box: Box, view: View, label: string, { values, labels }: Ticks): void {
  const left = Math.round(box.left) - 0.5;
  g.font = `11px ${UI_FONT}`;
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
  const widest = Math.max(0, ...labels.map((text) => g.measureText(text).width));
  g.save();
  g.translate(left - widest - 15, box.top + box.height / 2);
  g.rotate(-Math.PI / 2);
  drawSymbol(g, label, 0, 0, 15);
  g.restore();
}

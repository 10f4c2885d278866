/** A path that is small against the body, enlarged in a corner: an active cell moves by less than its own size. */

import { X, Y, type History } from "../history";
import { pretty, roundStep } from "../numbers";
import { UI_FONT } from "../plot";
import type { Inks } from "../theme";
import { behind } from "../units";
import type { Camera } from "./camera";

/** Side of the inset: at most, and at least, where the body would reach into it. */
const SIZES = { most: 132, least: 72 };
/** A deformed body reaches so many of its radii. */
const BULGE = 1.5;
const EDGE = 10;
const ROOM = 16;
const POINTS = 1200;
/** A path smaller than this share of the radius lies under the body. */
const HIDDEN = 0.8;

/** The least box around the samples from `from` on: left, lower, width, height. */
function bounds(history: History, from: number, stride: number): [number, number, number, number] {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let i = from; i < history.length; i += stride) {
    const [x, y] = [history.at(i, X), history.at(i, Y)];
    x0 = Math.min(x0, x);
    x1 = Math.max(x1, x);
    y0 = Math.min(y0, y);
    y1 = Math.max(y1, y);
  }
  return [x0, y0, x1 - x0, y1 - y0];
}

const place = (history: History, i: number): [number, number] => [history.at(i, X), history.at(i, Y)];

/** The largest size at which the inset keeps clear of a body with its centre here that reaches so many pixels. */
function sizeBeside(camera: Camera, x: number, y: number, reach: number): number {
  const [u, v] = [camera.toX(x), camera.toY(y)];
  let size = SIZES.most;
  const gap = (side: number, at: number): number => Math.max(0, side - EDGE - size - at);
  while (size > SIZES.least && Math.hypot(gap(camera.width, u), gap(camera.height, v)) < reach) size -= 2;
  return size;
}

/** Draws the inset where the whole trail would lie under a body of this radius; else nothing. */
export function paintInset(g: CanvasRenderingContext2D, camera: Camera, history: History, from: number, radius: number, colour: string, inks: Inks): void {
  const count = history.length - from;
  if (count < 8 || camera.width < 2.4 * SIZES.most) return;
  const stride = Math.ceil(count / POINTS);
  const box = bounds(history, from, stride);
  const extent = Math.max(box[2], box[3]);
  if (!(extent > 0) || extent > HIDDEN * radius) return;
  const size = sizeBeside(camera, ...place(history, history.length - 1), BULGE * camera.drawn * camera.scale);
  const [left, top] = [camera.width - size - EDGE, camera.height - size - EDGE];
  g.fillStyle = inks.plot;
  g.strokeStyle = inks.muted;
  g.lineWidth = 1;
  g.fillRect(left, top, size, size);
  g.strokeRect(left + 0.5, top + 0.5, size - 1, size - 1);
  const scale = (size - 2 * ROOM - 10) / extent;
  const toPixel = (i: number): [number, number] => [
    left + size / 2 + (history.at(i, X) - box[0] - box[2] / 2) * scale,
    top + size / 2 - 7 - (history.at(i, Y) - box[1] - box[3] / 2) * scale,
  ];
  paintPath(g, toPixel, history.start(from, stride), stride, history.length - 1, colour);
  paintBar(g, { left, top, size }, scale, camera.unit, inks);
}

/** The path from sample `first` to sample `last`, with a dot at its end. */
function paintPath(g: CanvasRenderingContext2D, place: (i: number) => [number, number], first: number, stride: number, last: number, colour: string): void {
  g.beginPath();
  for (let i = first; i < last; i += stride) g.lineTo(...place(i));
  g.lineTo(...place(last));
  g.strokeStyle = g.fillStyle = colour;
  g.lineWidth = 1.4;
  g.lineJoin = "round";
  g.stroke();
  g.beginPath();
  g.arc(...place(last), 3, 0, 2 * Math.PI);
  g.fill();
}

/** A bar of a round length below the path. */
function paintBar(g: CanvasRenderingContext2D, { left, top, size }: { left: number; top: number; size: number }, scale: number, unit: string | null, inks: Inks): void {
  const length = roundStep((0.45 * size) / scale);
  const [x, y] = [left + 8, top + size - 7];
  g.strokeStyle = g.fillStyle = inks.ink;
  g.lineWidth = 1.5;
  g.beginPath();
  g.moveTo(x, y - 3);
  g.lineTo(x, y);
  g.lineTo(x + length * scale, y);
  g.lineTo(x + length * scale, y - 3);
  g.stroke();
  g.font = `11px ${UI_FONT}`;
  g.textAlign = "left";
  g.fillText(`${pretty(length, 2)}${behind(unit)}`, x + 4, y - 5);
  g.textAlign = "right";
  g.fillStyle = inks.muted;
  g.fillText("path", left + size - 7, top + size - 8);
}

/** A path that is small against the body, enlarged in a corner: an active cell moves by less than its own size. */

import { X, Y, type History } from "../history";
import { pretty, roundStep } from "../numbers";
import { UI_FONT } from "../plot";
import type { Inks } from "../theme";
import type { Camera } from "./camera";

const SIZE = 132;
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

/** Draws the inset where the whole trail would lie under a body of this radius; else nothing. */
export function paintInset(g: CanvasRenderingContext2D, camera: Camera, history: History, from: number, radius: number, colour: string, inks: Inks): void {
  const count = history.length - from;
  if (count < 8 || camera.width < 2.4 * SIZE) return;
  const stride = Math.ceil(count / POINTS);
  const box = bounds(history, from, stride);
  const extent = Math.max(box[2], box[3]);
  if (!(extent > 0) || extent > HIDDEN * radius) return;
  const [left, top] = [camera.width - SIZE - EDGE, camera.height - SIZE - EDGE];
  g.fillStyle = inks.plot;
  g.strokeStyle = inks.muted;
  g.lineWidth = 1;
  g.fillRect(left, top, SIZE, SIZE);
  g.strokeRect(left + 0.5, top + 0.5, SIZE - 1, SIZE - 1);
  const scale = (SIZE - 2 * ROOM - 10) / extent;
  const place = (i: number): [number, number] => [
    left + SIZE / 2 + (history.at(i, X) - box[0] - box[2] / 2) * scale,
    top + SIZE / 2 - 7 - (history.at(i, Y) - box[1] - box[3] / 2) * scale,
  ];
  paintPath(g, place, history.start(from, stride), stride, history.length - 1, colour);
  paintBar(g, left, top, scale, inks);
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
function paintBar(g: CanvasRenderingContext2D, left: number, top: number, scale: number, inks: Inks): void {
  const length = roundStep(60 / scale);
  const [x, y] = [left + 8, top + SIZE - 7];
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
  g.fillText(pretty(length, 2), x + 4, y - 5);
  g.textAlign = "right";
  g.fillStyle = inks.muted;
  g.fillText("path", left + SIZE - 7, top + SIZE - 8);
}

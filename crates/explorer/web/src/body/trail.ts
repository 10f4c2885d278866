/** The path behind the body, fading with age: few strokes of different strength, at most some thousand points. */

import { X, Y, type History } from "../history";
import type { Camera } from "./camera";

const STROKES = 32;
const POINTS = 1800;

/** Draws the samples from `from` on, then on to the body at (bx, by). */
export function paintTrail(g: CanvasRenderingContext2D, camera: Camera, history: History, from: number, bx: number, by: number, colour: string): void {
  const count = history.length - from;
  if (count < 2) return;
  const stride = Math.max(1, Math.ceil(count / POINTS));
  const first = history.start(from, stride);
  const perStroke = Math.max(stride, Math.ceil(count / STROKES / stride) * stride);
  g.strokeStyle = colour;
  g.lineWidth = 1.6;
  g.lineJoin = "round";
  g.lineCap = "butt";
  for (let start = first; start < history.length; start += perStroke) {
    const end = Math.min(history.length - 1, start + perStroke);
    g.globalAlpha = 0.08 + 0.82 * ((end - from) / count) ** 1.4;
    g.beginPath();
    g.moveTo(camera.toX(history.at(start, X)), camera.toY(history.at(start, Y)));
    for (let i = start + stride; i <= end; i += stride) g.lineTo(camera.toX(history.at(i, X)), camera.toY(history.at(i, Y)));
    if (start + perStroke >= history.length) g.lineTo(camera.toX(bx), camera.toY(by));
    g.stroke();
  }
  g.globalAlpha = 1;
}

/** The path behind the body, fading with age: few strokes of different strength, with no more corners than the eye can see. */

import { X, Y, type History } from "../history";
import type { Camera } from "./camera";

const STROKES = 24;
const POINTS = 1800;
/** A corner is left out where the path goes by within so many pixels of it, */
const DEVIATION = 0.25;
/** and the corners beside it are so near. */
const CHORD = 6;

/** Strength of the newest and of the oldest piece. */
const [NEWEST, OLDEST] = [0.9, 0.08];

/** Draws the samples from `from` on. */
export function paintTrail(g: CanvasRenderingContext2D, camera: Camera, history: History, from: number, colour: string): void {
  const count = history.length - from;
  if (count < 2) return;
  const stride = Math.max(1, Math.ceil(count / POINTS));
  const first = history.start(from, stride);
  const perStroke = Math.max(stride, Math.ceil(count / STROKES / stride) * stride);
  pen(g, colour);
  const line = new Polyline(g);
  for (let start = first; start < history.length; start += perStroke) {
    const end = Math.min(history.length - 1, start + perStroke);
    g.globalAlpha = OLDEST + (NEWEST - OLDEST) * ((end - from) / count) ** 1.4;
    line.begin(camera.toX(history.at(start, X)), camera.toY(history.at(start, Y)));
    for (let i = start + stride; i <= end; i += stride) line.add(camera.toX(history.at(i, X)), camera.toY(history.at(i, Y)));
    if (start + perStroke >= history.length) line.add(camera.toX(history.at(end, X)), camera.toY(history.at(end, Y)));
    line.stroke();
  }
  g.globalAlpha = 1;
}

/** Draws the samples from `first` on at full strength, then on to the body at (bx, by). */
export function paintNewest(g: CanvasRenderingContext2D, camera: Camera, history: History, first: number, bx: number, by: number, colour: string): void {
  if (history.length < 2) return;
  pen(g, colour);
  g.globalAlpha = NEWEST;
  const line = new Polyline(g);
  line.begin(camera.toX(history.at(first, X)), camera.toY(history.at(first, Y)));
  for (let i = first + 1; i < history.length; i++) line.add(camera.toX(history.at(i, X)), camera.toY(history.at(i, Y)));
  line.add(camera.toX(bx), camera.toY(by));
  line.stroke();
  g.globalAlpha = 1;
}

function pen(g: CanvasRenderingContext2D, colour: string): void {
  g.strokeStyle = colour;
  g.lineWidth = 1.6;
  g.lineJoin = "bevel";
  g.lineCap = "butt";
}

/** A path without the corners that nobody would see. */
class Polyline {
  /** The last corner drawn. */
  private x = 0;
  private y = 0;
  /** The last point that came. */
  private u = 0;
  private v = 0;

  constructor(private readonly g: CanvasRenderingContext2D) {}

  begin(x: number, y: number): void {
    this.x = this.u = x;
    this.y = this.v = y;
    this.g.beginPath();
    this.g.moveTo(x, y);
  }

  add(x: number, y: number): void {
    if (this.matters(x, y)) {
      this.g.lineTo(this.u, this.v);
      this.x = this.u;
      this.y = this.v;
    }
    this.u = x;
    this.v = y;
  }

  stroke(): void {
    this.g.lineTo(this.u, this.v);
    this.g.stroke();
  }

  /** Whether the path to (x, y) would look different without the point before. */
  private matters(x: number, y: number): boolean {
    const [ax, ay] = [this.u - this.x, this.v - this.y];
    const [bx, by] = [x - this.x, y - this.y];
    const chord = bx * bx + by * by;
    if (chord > CHORD * CHORD) return true;
    // Beyond the chord's end, too: a path that turns back has its tip there.
    const along = ax * bx + ay * by;
    const across = ax * by - ay * bx;
    return along > chord || along < 0 || across * across > DEVIATION * DEVIATION * chord;
  }
}

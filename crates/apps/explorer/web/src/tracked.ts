/** A tracked cell beside the model that was fitted to it: its outlines at the time of the body, at the same scale. */

import type { Frame } from "./binary";
import { Backdrop } from "./body/backdrop";
import { Camera } from "./body/camera";
import { paintBody } from "./body/painting";
import { Sheet } from "./canvas";
import { byId, make, setText } from "./dom";
import { hideHalf, showHalf, type Beside } from "./half";
import { History, SHAPE } from "./history";
import { fixed } from "./numbers";
import type { Tracked } from "./protocol";
import { currentInks, edge } from "./theme";
import { unitsOfCell } from "./units";

/** Corners of an outline. */
const CORNERS = 96;
/** Numbers of a frame before its modes: time, x, y, R0. */
const FIRST_MODE = 4;
/** So many intervals between frames are a gap. */
const GAP = 1.5;
const COLOUR = "#8a8f94";

/** What the page shows of the body. */
export interface Sight {
  t: number;
  /** Pixels of a length. */
  scale: number;
  /** How much larger than true the body is drawn. */
  enlarged: number;
  /** Time of the trail. */
  trail: number;
}

export class TrackedView implements Beside {
  private readonly history = new History();
  private readonly camera = new Camera();
  private readonly backdrop = new Backdrop();
  private readonly sheet = new Sheet(byId<HTMLCanvasElement>("twin"), () => (this.dirty = true), true);
  private readonly clock = make("span", {});
  private readonly interval: number;
  private frame: Frame | null = null;
  /** Frames in the history. */
  private taken = 0;
  private dirty = true;

  constructor(
    readonly cell: Tracked,
    private readonly sight: () => Sight | null,
    private readonly ended: () => void,
  ) {
    const gaps = cell.frames.slice(1).map((frame, k) => frame[0] - cell.frames[k][0]).sort((a, b) => a - b);
    this.interval = gaps[gaps.length >> 1] ?? 1;
    showHalf(`The tracked cell ${cell.name}, at the same scale as the body`, "Hide the tracked cell");
    this.camera.unit = unitsOfCell(cell).length;
    byId("twin-label").replaceChildren(make("b", {}, `tracked cell ${cell.name}`), this.clock);
  }

  end(): void {
    hideHalf();
    this.ended();
  }

  touch(): void {
    this.backdrop.forget();
    this.dirty = true;
  }

  shown(): Frame | null {
    return this.frame;
  }

  draw(seconds: number): void {
    const [sight, { camera, sheet, history, cell }] = [this.sight(), this];
    if (!sight || !sheet.width) return;
    const duration = cell.frames[cell.frames.length - 1][0];
    const frame = this.advance(duration > 0 ? sight.t % duration : 0);
    [camera.width, camera.height] = [sheet.width, sheet.height];
    const from = history.since(frame.t - sight.trail);
    camera.aim(history, from, frame.x, frame.y, frame.radius, [], sight.scale);
    camera.drawn = frame.radius * sight.enlarged;
    if (!camera.step(seconds) && !this.dirty) return;
    this.dirty = false;
    const scene = { camera, history, from, frame, outline: frame.outline, enlarged: sight.enlarged, colour: COLOUR, edge: edge(COLOUR), pointed: -1 };
    this.backdrop.paint(sheet, scene, currentInks());
    paintBody(sheet.g, scene, currentInks());
    const notes = [frame.outlined ? "" : ", no frame here", sight.enlarged > 1 ? `, drawn ${sight.enlarged}\u00d7` : ""];
    setText(this.clock, `${fixed(frame.t, 1)} of ${fixed(duration, 1)} ${unitsOfCell(cell).time}${notes.join("")}`);
  }

  /** The cell at a time: its frames up to then go to the history; after the last one it begins again. */
  private advance(t: number): Frame {
    const { frames } = this.cell;
    if (this.frame && t === this.frame.t) return this.frame;
    if (this.frame && t < this.frame.t) {
      this.history.clear();
      this.taken = 0;
      this.camera.jump();
    }
    const rows: number[] = [];
    for (; this.taken < frames.length && frames[this.taken][0] <= t; this.taken++) rows.push(...this.sample(this.taken));
    this.frame = { ...this.between(Math.max(0, this.taken - 1), t), rows: Float64Array.from(rows), columns: SHAPE };
    this.history.take(this.frame);
    this.dirty = true;
    return this.frame;
  }

  /** A row of the history: time, place, speed. */
  private sample(k: number): number[] {
    const { frames } = this.cell;
    const [[t, x, y], [s, u, v]] = [frames[k], frames[Math.max(0, k - 1)]];
    return [t, x, y, t > s ? Math.hypot(x - u, y - v) / (t - s) : 0, 0];
  }

  /** Between the frames k and k + 1: what lies in between is interpolated, but not across a gap. */
  private between(k: number, t: number): Frame {
    const { frames } = this.cell;
    const [now, next] = [frames[k], frames[Math.min(k + 1, frames.length - 1)]];
    const gap = next[0] - now[0] > GAP * this.interval;
    const part = gap || next[0] <= now[0] ? 0 : (t - now[0]) / (next[0] - now[0]);
    const values = now.map((value, i) => value + part * (next[i] - value));
    const [, x, y, radius] = values;
    const outlined = !gap || t <= now[0];
    const none = new Float64Array(0);
    return { kind: "frame", revision: 0, outlined, behind: false, t, x, y, radius, state: none, rows: none, columns: SHAPE, outline: outline(values) };
  }
}

/** R0 + sum 2 Re(z_n exp(i n theta)) about the centre. */
function outline(values: number[]): Float64Array {
  const points = new Float64Array(2 * CORNERS);
  for (let k = 0; k < CORNERS; k++) {
    const angle = (2 * Math.PI * k) / CORNERS;
    let radius = values[FIRST_MODE - 1];
    for (let i = FIRST_MODE; i + 1 < values.length; i += 2) {
      const turned = ((i - FIRST_MODE) / 2 + 2) * angle;
      radius += 2 * (values[i] * Math.cos(turned) - values[i + 1] * Math.sin(turned));
    }
    points[2 * k] = radius * Math.cos(angle);
    points[2 * k + 1] = radius * Math.sin(angle);
  }
  return points;
}

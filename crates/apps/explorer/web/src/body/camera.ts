/** Which part of the plane is in sight: follows body and trail smoothly, or stays where the reader left it. */

import type { History } from "../history";
import { X, Y } from "../history";

/** Half the sight is at most so many radii of the body, or the path would shrink the body to a dot. */
const WIDEST = 40;
/** and at least so many. */
const CLOSEST = 3;
/** Pixels at the top that the clock takes, and that it takes with a note below. */
const CLOCK = { alone: 24, noted: 68 };
/** A deformed body reaches so many of its radii. */
const BULGE = 1.5;
/** At the ends of its trail it has so many: there it may touch the edge. */
const ROOM = 1.2;
/** Seconds in which the camera makes up for most of its lag. */
const EASE = 0.45;
/** So near its goal (pixels) the camera rests, until its goal is so far away. */
const NEAR = 0.5;
const AWAY = 2;
/** The trail is looked at in so many points: so many that its box does not tremble. */
const POINTS = 1600;
/** Room about trail and body, as a part of the sight. */
const MARGIN = 1.04;
/** At most this part of the sight is kept free for the body at the ends of its trail. */
const MOST_ROOM = 0.3;

export class Camera {
  follow = true;
  /** Whether a note stands below the clock. */
  noted = false;
  /** The body is in the hand: the sight does not move. */
  held = false;
  /** Whether it stands still. */
  resting = false;
  /** Pixels per unit of length. */
  scale = 40;
  /** The unit of length; `null`: the model's own. */
  unit: string | null = null;
  x = 0;
  y = 0;
  width = 1;
  height = 1;
  private zoom = 1;
  private fresh = true;
  private body = { x: 0, y: 0 };
  /** Radius that the body is drawn with. */
  drawn = 0;
  /** Size of the trail: the longer side of its box. */
  extent = 0;
  private goal = { x: 0, y: 0, scale: 40 };

  /** The next aim is taken at once: a new body. */
  jump(): void {
    this.fresh = true;
  }

  toX(x: number): number {
    return this.width / 2 + (x - this.x) * this.scale;
  }

  toY(y: number): number {
    return this.height / 2 - (y - this.y) * this.scale;
  }

  /** Aims at the trail from sample `from` on, at the body, with its radius, and at other places; at the scale `given`, or one that suits them. */
  aim(history: History, from: number, bx: number, by: number, radius: number, others: [number, number][] = [], given?: number): void {
    this.body = { x: bx, y: by };
    let [x0, x1, y0, y1] = [bx, bx, by, by];
    const stride = Math.max(1, Math.floor((history.length - from) / POINTS));
    for (let i = from; i < history.length; i += stride) {
      const [x, y] = [history.at(i, X), history.at(i, Y)];
      x0 = Math.min(x0, x);
      x1 = Math.max(x1, x);
      y0 = Math.min(y0, y);
      y1 = Math.max(y1, y);
    }
    for (const [x, y] of others) [x0, x1, y0, y1] = [Math.min(x0, x), Math.max(x1, x), Math.min(y0, y), Math.max(y1, y)];
    this.extent = Math.max(x1 - x0, y1 - y0);
    const least = Math.min(this.width, this.height) / 2;
    const fit = Math.min(this.free(this.width, 0) / (x1 - x0), this.free(this.height, this.taken) / (y1 - y0)) / MARGIN;
    const scale = given ?? this.zoom * Math.min(least / (CLOSEST * radius), Math.max(least / (WIDEST * radius), fit));
    // A trail that is too long for the sight is seen from nearer the body.
    const lag = scale > fit ? 0.26 : Infinity;
    this.goal = { x: toward((x0 + x1) / 2, bx, (lag * this.width) / scale), y: toward((y0 + y1) / 2, by, (lag * this.height) / scale), scale };
  }

  /** Moves on by `seconds`; tells whether anything moved visibly. */
  step(seconds: number): boolean {
    if (this.held || (!this.follow && !this.fresh)) {
      this.resting = true;
      return false;
    }
    const { x, y, scale } = this;
    this.resting = !this.fresh && this.astray() < (this.resting ? AWAY : NEAR);
    const part = this.fresh ? 1 : this.resting ? 0 : 1 - Math.exp(-seconds / EASE);
    this.fresh = false;
    this.scale *= (this.goal.scale / scale) ** part;
    this.x = toward(x + (this.goal.x - x) * part, this.body.x, this.reach(this.width, 0));
    this.y = toward(y + (this.goal.y - y) * part, this.body.y, this.reach(this.height, this.taken));
    return this.x !== x || this.y !== y || this.scale !== scale;
  }

  /** Pixels at the top that are taken. */
  private get taken(): number {
    return this.noted ? CLOCK.noted : CLOCK.alone;
  }

  /** How far from its goal the sight is, in pixels. */
  private astray(): number {
    const zoomed = 0.5 * Math.max(this.width, this.height) * Math.abs(Math.log(this.goal.scale / this.scale));
    return Math.max(zoomed, this.scale * Math.hypot(this.goal.x - this.x, this.goal.y - this.y));
  }

  /** The part of a side that the trail may fill, for the body to be in sight at both ends. */
  private free(side: number, taken: number): number {
    return side - 2 * Math.min(MOST_ROOM * side, 0.5 * taken + ROOM * this.drawn * this.scale);
  }

  /** How far the body may be from the middle of a side: it stays in sight whole, below the clock. */
  private reach(side: number, taken: number): number {
    return Math.max(0, 0.48 * side - taken - BULGE * this.drawn * this.scale) / this.scale;
  }

  /** Zooms about a pixel; while the camera follows, about the body. */
  zoomBy(factor: number, px: number, py: number): void {
    this.zoom = Math.min(50, Math.max(0.02, this.zoom * factor));
    if (!this.follow) {
      this.x += (px - this.width / 2) * (1 / this.scale - 1 / (this.scale * factor));
      this.y -= (py - this.height / 2) * (1 / this.scale - 1 / (this.scale * factor));
    }
    this.scale *= factor;
  }

  pan(dx: number, dy: number): void {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** The zoom that suits body and trail; whether it follows is not touched. */
  reset(): void {
    this.zoom = 1;
  }
}

/** `centre`, moved so that `must` is no further from it than `reach`. */
function toward(centre: number, must: number, reach: number): number {
  return Math.min(must + reach, Math.max(must - reach, centre));
}

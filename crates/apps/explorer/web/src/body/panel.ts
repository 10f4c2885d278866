/** The body in motion, in its place on the page. */

import type { Frame } from "../binary";
import { Sheet } from "../canvas";
import { byId, setText } from "../dom";
import { SPEED, T, X, Y, type History } from "../history";
import { fixed } from "../numbers";
import type { Orbit, Values, Wish } from "../protocol";
import { watch } from "../pointer";
import { currentInks, edge } from "../theme";
import type { Sight } from "../tracked";
import { units } from "../units";
import { Backdrop } from "./backdrop";
import { Camera } from "./camera";
import { Ghost } from "./ghost";
import { grab, under, type GrabHost } from "./grab";
import { listenToKeys } from "./keys";
import { paintBody } from "./painting";
import type { Swarm } from "./swarm";

/** The body is drawn at least and at most so large (radius in pixels) before its enlargement changes. */
const SMALLEST = 15;
const LARGEST = 52;
const ENLARGEMENTS = [1, 2, 3, 5, 8, 12, 20, 30, 50, 80, 120, 200, 500];
const CLOCK_GAP = 100;

/** What the hand does to the body. */
export interface Hand {
  /** Model time per second. */
  speed(): number;
  hold(held: boolean): void;
  wish(wish: Wish, last: boolean): void;
}

export class BodyPanel {
  readonly camera = new Camera();
  private readonly sheet: Sheet;
  private readonly backdrop = new Backdrop();
  private frame: Frame | null = null;
  private outline: Float64Array | null = null;
  private enlarged = 1;
  private trueSize = false;
  private dirty = false;
  private colour = "#888888";
  private edge = "#888888";
  private clockAt = 0;
  private trail = 100;
  /** The orbit that the body was placed on. */
  private ghost: Ghost | null = null;
  /** Time that the cursor of the series points at. */
  private pointed: number | null = null;

  constructor(
    private readonly history: History,
    private readonly followed: (follow: boolean) => void,
    private readonly hand: Hand,
    private readonly swarm: Swarm,
  ) {
    const canvas = byId<HTMLCanvasElement>("body");
    this.sheet = new Sheet(canvas, () => (this.dirty = true), true);
    const host = this.grabbed();
    watch(canvas, {
      grab: (at, touch) => grab(host, at, touch),
      hover: (at) => (canvas.dataset.under = (at && under(host, at, false)) ?? ""),
      pan: (dx, dy) => {
        this.setFollow(false);
        this.camera.pan(dx, dy);
        this.dirty = true;
      },
      zoom: (factor, x, y) => {
        this.camera.zoomBy(factor, x, y);
        this.dirty = true;
      },
      double: () => {
        this.camera.reset();
        this.setFollow(true);
      },
    });
    listenToKeys(canvas, host, () => this.heading());
    byId("true-size").addEventListener("click", () => this.toggleSize());
  }

  /** What the hand sees of the body. */
  private grabbed(): GrabHost {
    return {
      camera: this.camera,
      frame: () => this.frame,
      outline: () => this.outline,
      enlarged: () => this.enlarged,
      fastest: () => this.fastest(),
      speed: () => this.hand.speed(),
      wish: (wish, last) => this.hand.wish(wish, last),
      hold: (held) => {
        this.camera.held = held;
        this.dirty = true;
        this.hand.hold(held);
      },
    };
  }

  /** Pixels of a model length at the size in which the body is drawn. */
  get scale(): number {
    return this.camera.scale * this.enlarged;
  }

  /** How the body is seen; `null` before it was. */
  sight(): Sight | null {
    const { frame, camera, enlarged, trail } = this;
    return frame && { t: frame.t, scale: camera.scale, enlarged, trail };
  }

  /** The largest speed of the trail. */
  private fastest(): number {
    let most = 0;
    for (let i = this.history.since(this.since()); i < this.history.length; i += 4) most = Math.max(most, this.history.at(i, SPEED));
    return most;
  }

  /** The direction of motion. */
  private heading(): number {
    const [last, before] = [this.history.length - 1, this.history.length - 2];
    if (before < 0) return 0;
    return Math.atan2(this.history.at(last, Y) - this.history.at(before, Y), this.history.at(last, X) - this.history.at(before, X));
  }

  /** The last frame that came. */
  last(): Frame | null {
    return this.frame;
  }

  /** A new body: the sight jumps to it. */
  begin(): void {
    this.camera.unit = units().length;
    this.backdrop.forget();
    this.frame = this.outline = null;
    this.show(null);
    this.camera.jump();
    this.dirty = true;
  }

  take(frame: Frame): void {
    if (this.frame && frame.t < this.frame.t - 1e-9) {
      this.camera.jump();
      this.show(null);
    }
    this.frame = frame;
    if (frame.outlined && frame.outline.length) this.outline = frame.outline;
    this.dirty = true;
  }

  touch(): void {
    this.dirty = true;
  }

  setColour(colour: string): void {
    this.colour = colour;
    this.edge = edge(colour);
    this.dirty = true;
  }

  /** Model time of the trail. */
  setTrail(time: number): void {
    this.trail = time;
    this.backdrop.forget();
    this.dirty = true;
  }

  /** The body is placed on an orbit. */
  place(orbit: Orbit): void {
    this.show(new Ghost(orbit));
  }

  /** The motion is that of a body with these parameters: another one has other orbits. */
  renew(revision: number, parameters: Values): void {
    const { ghost } = this;
    if (ghost && revision >= ghost.revision && !ghost.holds(parameters)) this.show(null);
  }

  private show(ghost: Ghost | null): void {
    this.ghost = ghost;
    this.camera.noted = ghost !== null;
    this.dirty = true;
    const note = byId("orbit-note");
    note.hidden = !ghost;
    note.toggleAttribute("data-unstable", ghost !== null && ghost.unstable > 0);
    setText(note, ghost ? words(ghost) : "");
  }

  setFollow(follow: boolean): void {
    if (this.camera.follow !== follow) this.followed(follow);
    this.camera.follow = follow;
    this.dirty = true;
  }

  point(time: number | null): void {
    if (this.pointed !== time) this.dirty = true;
    this.pointed = time;
  }

  /** Draws where anything moved, and tells whether it did; `seconds` since the last picture. */
  draw(seconds: number): boolean {
    const { frame, camera, sheet } = this;
    if (!frame || !sheet.width) return false;
    [camera.width, camera.height] = [sheet.width, sheet.height];
    const from = this.history.since(frame.t - this.trail);
    if (this.dirty) camera.aim(this.history, from, frame.x, frame.y, frame.radius, this.swarm.places());
    camera.drawn = frame.radius * this.enlarged;
    if (!camera.step(seconds) && !this.dirty) return false;
    this.dirty = false;
    this.enlarge(frame.radius);
    const pointed = this.pointed === null ? -1 : Math.min(this.history.length - 1, this.history.since(this.pointed));
    const scene = { camera, history: this.history, from, frame, outline: this.outline, enlarged: this.enlarged, colour: this.colour, edge: this.edge, pointed };
    this.backdrop.paint(sheet, scene, currentInks());
    if (this.ghost?.left(frame)) this.show(null);
    this.ghost?.paint(sheet.g, camera, this.since(), frame.t, currentInks());
    this.swarm.paint(sheet.g, camera, this.enlarged);
    paintBody(sheet.g, scene, currentInks());
    this.clock(frame);
    return true;
  }

  /** The least enlargement that makes the body visible, kept while it is neither tiny nor huge. */
  private enlarge(radius: number): void {
    const pixels = radius * this.camera.scale;
    const now = pixels * this.enlarged;
    if (this.trueSize) this.enlarged = 1;
    else if (now < SMALLEST || (this.enlarged > 1 && now > LARGEST)) {
      this.enlarged = ENLARGEMENTS.find((factor) => pixels * factor >= 1.3 * SMALLEST) ?? 1;
    }
    const button = byId("true-size");
    button.hidden = !this.trueSize && this.enlarged === 1;
    setText(button, this.trueSize ? "true size" : `body drawn ${this.enlarged}\u00d7`);
  }

  private toggleSize(): void {
    this.trueSize = !this.trueSize;
    byId("true-size").setAttribute("aria-pressed", String(this.trueSize));
    this.dirty = true;
  }

  /** Time and place in figures, ten times a second. */
  private clock(frame: Frame): void {
    const now = performance.now();
    if (now - this.clockAt < CLOCK_GAP) return;
    this.clockAt = now;
    setText(byId("clock-t"), fixed(frame.t, 1));
    // A digit more than the sight resolves, and two more than the size of the path.
    const resolved = Math.ceil(Math.log10(this.camera.scale / (this.enlarged > 1 ? 1 : 20)));
    const digits = Math.min(8, Math.max(2, resolved, 2 - Math.floor(Math.log10(this.camera.extent || 1))));
    setText(byId("clock-x"), fixed(frame.x, digits));
    setText(byId("clock-y"), fixed(frame.y, digits));
    const late = frame.behind ? "computation is slower than this speed: the body lags behind" : "";
    setText(byId("body-note"), frame.outlined || !frame.outline.length && !this.outline ? late : "the outline is not a closed curve here");
  }

  /** Time of the first sample in sight. */
  since(): number {
    return (this.frame?.t ?? 0) - this.trail;
  }

  /** Time of the last sample. */
  now(): number {
    return this.history.length ? this.history.at(this.history.length - 1, T) : 0;
  }
}

function words(ghost: Ghost): string {
  if (ghost.unstable === 0) return "stable: the body stays on this orbit (dashed; ring: a body exactly on it)";
  return "unstable: the body leaves this orbit (dashed; ring: a body exactly on it). It started 0.1 % off.";
}

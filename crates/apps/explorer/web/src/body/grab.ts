/** The body in the hand: its outline is pulled, its inside carried to another place, and thrown where the hand lets go while it moves. */

import type { Frame } from "../binary";
import type { Held } from "../pointer";
import type { Wish } from "../protocol";
import type { Camera } from "./camera";

/** The outline is caught within so many pixels, by a mouse and by a finger, or within this part of its extent. */
const CATCH = { mouse: 9, touch: 18, part: 0.16 };
/** Nearer to the centre than this part of the extent the outline is never caught. */
const INSIDE = 0.6;
/** A hand that moves less than so many pixels holds the body still. */
const SLACK = 4;
/** The speed of the hand is that of its last so many milliseconds. */
const LAST = 90;
/** A hand that has not moved for so long (milliseconds) rests. */
const RESTED = 100;
/** Below so many pixels per second the body is put down, not thrown. */
const THROWN = 80;
/** A body is thrown at most so many times as fast as it has been of late; and at least as fast as so many radii per time. */
const FASTEST = { of: 3, least: 1 };

/** What the hand needs of the body's picture and of the page. */
export interface GrabHost {
  readonly camera: Camera;
  frame(): Frame | null;
  outline(): Float64Array | null;
  /** How much larger than true the body is drawn. */
  enlarged(): number;
  /** Model time per second; and the largest speed of late. */
  speed(): number;
  fastest(): number;
  /** The motion rests while the body is held. */
  hold(held: boolean): void;
  /** What the hand does: sent when the one before is answered, the last one at once. */
  wish(wish: Wish, last: boolean): void;
}

type Kind = "pull" | "carry";

/** What a hand at this pixel would do; `null` beside the body. */
export function under(host: GrabHost, [px, py]: [number, number], touch: boolean): Kind | null {
  const frame = host.frame();
  if (!frame) return null;
  const [u, v] = [px - host.camera.toX(frame.x), host.camera.toY(frame.y) - py];
  const reach = extent(host, frame, Math.atan2(v, u));
  const distance = Math.hypot(u, v);
  const near = Math.max(touch ? CATCH.touch : CATCH.mouse, CATCH.part * reach);
  if (host.outline() && Math.abs(distance - reach) < near && distance > INSIDE * reach) return "pull";
  return distance < reach ? "carry" : null;
}

/** Pixels from the centre to the outline, in this direction. */
export function extent(host: GrabHost, frame: Frame, angle: number): number {
  const scale = host.camera.scale * host.enlarged();
  const outline = host.outline();
  if (!outline) return frame.radius * scale;
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  const point = (k: number): [number, number] => {
    const [x, y] = [outline[k % outline.length], outline[(k + 1) % outline.length]];
    return [cosine * x + sine * y, cosine * y - sine * x];
  };
  let most = 0;
  for (let k = 0; k < outline.length; k += 2) {
    const [a, b] = [point(k), point(k + 2)];
    if (a[1] > 0 !== b[1] > 0) most = Math.max(most, a[0] + ((b[0] - a[0]) * a[1]) / (a[1] - b[1]));
  }
  return most * scale;
}

/** Takes the body up; `null` where there is none. */
export function grab(host: GrabHost, at: [number, number], touch: boolean): Held | null {
  const [kind, frame] = [under(host, at, touch), host.frame()];
  if (!kind || !frame) return null;
  host.hold(true);
  return kind === "pull" ? new Pull(host, frame, at) : new Carry(host, frame, at);
}

/** The outline follows the hand. */
class Pull implements Held {
  private readonly state: number[];
  /** What the hand was off the outline, in pixels. */
  private readonly off: number;
  private to: [number, number] | null = null;

  constructor(
    private readonly host: GrabHost,
    private readonly frame: Frame,
    private readonly start: [number, number],
  ) {
    this.state = [...frame.state];
    const [u, v] = this.from(start);
    this.off = extent(host, frame, Math.atan2(v, u)) - Math.hypot(u, v);
  }

  move(at: [number, number]): void {
    if (!this.to && Math.hypot(at[0] - this.start[0], at[1] - this.start[1]) < SLACK) return;
    const [u, v] = this.from(at);
    const distance = Math.hypot(u, v);
    if (!(distance > 0)) return;
    const part = Math.max(0.1, (distance + this.off) / distance) / (this.host.camera.scale * this.host.enlarged());
    this.to = [u * part, v * part];
    this.host.wish({ do: "pull", state: this.state, to: this.to }, false);
  }

  drop(): void {
    if (this.to) this.host.wish({ do: "pull", state: this.state, to: this.to }, true);
    this.host.hold(false);
  }

  /** Pixels from the centre of the body, upwards positive. */
  private from([px, py]: [number, number]): [number, number] {
    return [px - this.host.camera.toX(this.frame.x), this.host.camera.toY(this.frame.y) - py];
  }
}

/** The body follows the hand. */
class Carry implements Held {
  private readonly track: { at: [number, number]; time: number }[] = [];
  private moved = false;

  constructor(
    private readonly host: GrabHost,
    private readonly frame: Frame,
    private readonly start: [number, number],
  ) {}

  move(at: [number, number]): void {
    const time = performance.now();
    this.track.push({ at, time });
    while (this.track.length > 2 && time - this.track[0].time > LAST) this.track.shift();
    this.moved ||= Math.hypot(at[0] - this.start[0], at[1] - this.start[1]) >= SLACK;
    if (this.moved) this.host.wish(put(this.place(at), null), false);
  }

  drop(): void {
    const last = this.track.at(-1);
    if (this.moved && last) this.host.wish(put(this.place(last.at), this.velocity()), true);
    this.host.hold(false);
  }

  private place([px, py]: [number, number]): [number, number] {
    const { frame, start, host } = this;
    return [frame.x + (px - start[0]) / host.camera.scale, frame.y - (py - start[1]) / host.camera.scale];
  }

  /** The velocity of the hand in model lengths per model time; `null` where it rests. */
  private velocity(): [number, number] | null {
    const [first, last] = [this.track[0], this.track[this.track.length - 1]];
    // A hand that rested before it let go has put the body down.
    const now = performance.now();
    if (now - last.time > RESTED) return null;
    const seconds = (now - first.time) / 1000;
    const [u, v] = [last.at[0] - first.at[0], first.at[1] - last.at[1]];
    if (seconds <= 0 || Math.hypot(u, v) / seconds < THROWN) return null;
    const { host, frame } = this;
    const per = seconds * host.camera.scale * host.speed();
    const speed = Math.hypot(u, v) / per;
    const most = Math.max(FASTEST.of * host.fastest(), FASTEST.least * frame.radius);
    const part = Math.min(1, most / speed) / per;
    return [u * part, v * part];
  }
}

export function put(position: [number, number], velocity: [number, number] | null): Wish {
  return { do: "put", parameters: {}, state: null, position, velocity, t: null, noise: null };
}

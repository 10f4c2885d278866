/** The orbit that the body was placed on: drawn as far as the trail goes back, and one period ahead; and where the body would be on it. */

import type { Frame } from "../binary";
import type { Orbit, Values } from "../protocol";
import type { Inks } from "../theme";
import type { Camera } from "./camera";

/** No more periods than this are drawn. */
const MOST = 120;
/** A body that is so many of its radii from where it would be has left. */
const GONE = 150;
const DASH = [5, 4];

export class Ghost {
  /** Where each period begins, and how it is turned. */
  private readonly starts: { x: number; y: number; angle: number }[];

  constructor(private readonly orbit: Orbit) {
    const [x, y] = orbit.position;
    this.starts = [{ x, y, angle: 0 }];
  }

  /** Number of growing directions. */
  get unstable(): number {
    return this.orbit.unstable;
  }

  get revision(): number {
    return this.orbit.revision;
  }

  /** Whether it is an orbit of a body with these parameters. */
  holds(parameters: Values): boolean {
    const own = this.orbit.parameters;
    return Object.keys(own).every((name) => own[name] === parameters[name]);
  }

  /** Draws the periods from time `from` on to one after `t`. */
  paint(g: CanvasRenderingContext2D, camera: Camera, from: number, t: number, inks: Inks): void {
    const { orbit } = this;
    const number = (time: number): number => Math.max(0, Math.floor((time - orbit.t) / orbit.time));
    const last = number(t) + 1;
    const path = new Path2D();
    for (let k = Math.max(number(from), last - MOST); k <= last; k++) {
      orbit.points.forEach((_, i) => (i ? path.lineTo(...this.pixel(camera, k, i)) : path.moveTo(...this.pixel(camera, k, i))));
    }
    g.lineJoin = "round";
    g.strokeStyle = inks.plot;
    g.lineWidth = 3;
    g.stroke(path);
    g.strokeStyle = inks.ink;
    g.lineWidth = 1.1;
    g.setLineDash(DASH);
    g.stroke(path);
    g.setLineDash([]);
    this.paintPlace(g, camera, t, inks);
  }

  /** Whether the body is far from where it would be. */
  left({ t, x, y, radius }: Frame): boolean {
    const [u, v] = this.place(t);
    return Math.hypot(u - x, v - y) > GONE * radius;
  }

  /** Where the body would be. */
  private place(t: number): [number, number] {
    const { orbit } = this;
    const periods = Math.max(0, (t - orbit.t) / orbit.time);
    const point = Math.round((periods % 1) * (orbit.points.length - 1));
    return moved(this.start(Math.floor(periods)), orbit.points[point]);
  }

  /** A ring where the body would be. */
  private paintPlace(g: CanvasRenderingContext2D, camera: Camera, t: number, inks: Inks): void {
    const at = this.place(t);
    const [x, y] = [camera.toX(at[0]), camera.toY(at[1])];
    g.beginPath();
    g.arc(x, y, 4, 0, 2 * Math.PI);
    g.fillStyle = inks.plot;
    g.fill();
    g.strokeStyle = inks.ink;
    g.lineWidth = 1.3;
    g.stroke();
  }

  private pixel(camera: Camera, period: number, point: number): [number, number] {
    const start = this.start(period);
    const [x, y] = moved(start, this.orbit.points[point]);
    return [camera.toX(x), camera.toY(y)];
  }

  /** Each period begins where the one before ends. */
  private start(period: number): { x: number; y: number; angle: number } {
    const { points, rotation } = this.orbit;
    for (let k = this.starts.length; k <= period; k++) {
      const before = this.starts[k - 1];
      const [x, y] = moved(before, points[points.length - 1]);
      this.starts.push({ x, y, angle: before.angle + rotation });
    }
    return this.starts[period];
  }
}

function moved({ x, y, angle }: { x: number; y: number; angle: number }, [u, v]: [number, number]): [number, number] {
  const [sine, cosine] = [Math.sin(angle), Math.cos(angle)];
  return [x + cosine * u - sine * v, y + sine * u + cosine * v];
}

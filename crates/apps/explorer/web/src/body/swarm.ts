/** The bodies of a swarm, drawn beside the body: each in the colour of the motion that it ends in, few of them with their paths. */

import type { SwarmFrame } from "../binary";
import type { Regime } from "../protocol";
import { currentInks, edge, visible } from "../theme";
import type { Camera } from "./camera";

/** So many bodies have paths, of so many points. */
const PATHS = 12;
const POINTS = 4000;
/** Numbers of a body: x, y, distance. */
const EACH = 3;
const NAMELESS = "#8a8f94";

export class Swarm {
  private frame: SwarmFrame | null = null;
  private readonly regimes: (Regime | null)[] = [];
  private readonly paths: number[][] = [];
  /** Whether the bodies have names: those from many starts. */
  named = false;

  get count(): number {
    return this.frame?.count ?? 0;
  }

  /** How far the first body is from the body, in the coordinates of the shape. */
  get distance(): number {
    return this.frame?.numbers[2] ?? NaN;
  }

  begin(named: boolean): void {
    this.clear();
    this.named = named;
  }

  clear(): void {
    this.frame = null;
    this.paths.length = this.regimes.length = 0;
  }

  /** The parameters changed: the motions may end elsewhere. */
  renew(): void {
    this.regimes.length = 0;
  }

  name(body: number, regime: Regime | null): void {
    this.regimes[body] = regime;
  }

  /** How many bodies end in each motion, the most frequent first. */
  shares(): [Regime, number][] {
    const counts = new Map<Regime, number>();
    for (const regime of this.regimes) if (regime) counts.set(regime, (counts.get(regime) ?? 0) + 1);
    return [...counts].sort((a, b) => b[1] - a[1]);
  }

  take(frame: SwarmFrame): void {
    this.frame = frame;
    if (frame.count > PATHS) return;
    for (let k = 0; k < frame.count; k++) {
      const path = (this.paths[k] ??= []);
      path.push(frame.numbers[EACH * k], frame.numbers[EACH * k + 1]);
      if (path.length > 2 * POINTS) path.splice(0, POINTS);
    }
  }

  /** Places of all bodies: x, y. */
  places(): [number, number][] {
    const { frame } = this;
    return Array.from({ length: this.count }, (_, k) => [frame?.numbers[EACH * k] ?? 0, frame?.numbers[EACH * k + 1] ?? 0]);
  }

  paint(g: CanvasRenderingContext2D, camera: Camera, enlarged: number): void {
    const { frame } = this;
    if (!frame) return;
    const size = camera.scale * enlarged;
    g.lineWidth = 1.2;
    g.lineJoin = "round";
    for (const [k, [x, y]] of this.places().entries()) {
      const colour = this.colour(k);
      this.paintPath(g, camera, k, colour);
      const [u, v] = [camera.toX(x), camera.toY(y)];
      g.beginPath();
      for (let i = 0; i < frame.points; i++) {
        const at = 2 * (k * frame.points + i);
        g.lineTo(u + size * frame.outlines[at], v - size * frame.outlines[at + 1]);
      }
      g.closePath();
      g.fillStyle = colour;
      g.strokeStyle = edge(colour);
      g.globalAlpha = 0.22;
      g.fill();
      g.globalAlpha = 0.9;
      g.stroke();
    }
    g.globalAlpha = 1;
  }

  private paintPath(g: CanvasRenderingContext2D, camera: Camera, k: number, colour: string): void {
    const path = this.paths[k] ?? [];
    g.beginPath();
    for (let i = 0; i < path.length; i += 2) g.lineTo(camera.toX(path[i]), camera.toY(path[i + 1]));
    g.strokeStyle = colour;
    g.globalAlpha = 0.7;
    g.stroke();
  }

  private colour(k: number): string {
    if (!this.named) return currentInks().ink;
    const regime = this.regimes[k];
    return regime ? visible(regime.colour) : NAMELESS;
  }
}

/** Running Lyapunov exponents with their 95 % band, against the time they are averaged over. */

import type uPlot from "uplot";
import { byId, setText } from "../dom";
import { withError } from "../numbers";
import type { Exponents } from "../protocol";
import { currentInks, curve, DASHES } from "../theme";
import { units } from "../units";
import { axis, chart, across, roomy, upward } from "./chart";
import { showKeys } from "./keys";

const MOST = 3;
/** Above so many points every other one goes. */
const POINTS = 800;
const PER_CURVE = 3;
/** Room above the curves for keys and numbers. */
const HEADROOM = 0.55;
/** Exponents that differ by less are not told apart by eye. */
const LEAST = 2e-3;
/** So few points are drawn as points, too. */
const FEW = 12;

export class ExponentStrip {
  private readonly plot: uPlot;
  private readonly time: number[] = [];
  /** Value, upper and lower end of each exponent, one after the other. */
  private readonly curves: (number | null)[][] = Array.from({ length: PER_CURVE * MOST }, () => []);
  private dirty = true;
  /** Room that the numbers of the upward axis take. */
  private room = 50;

  constructor() {
    const indices = Array.from({ length: MOST }, (_, i) => i);
    const edge = { width: 0, points: { show: false } };
    this.plot = chart(byId("exponents"), "Lyapunov exponents against averaging time", {
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: { x: { time: false }, y: { range: () => this.range() } },
      padding: [8, 20, 0, 0],
      axes: [axis({ ...across(), size: 20 }), axis({ ...upward(4, HEADROOM, (power, room) => this.told(power, room)), size: () => this.room })],
      series: [{}, ...indices.flatMap((i) => [{ stroke: () => curve(i), dash: DASHES[i], width: 1.8, points: { show: () => this.time.length < FEW, size: 5 } }, edge, edge])],
      bands: indices.map((i) => ({ series: [PER_CURVE * i + 2, PER_CURVE * i + 3], fill: () => `${curve(i)}33` })),
      hooks: { drawAxes: [zero] },
    }, [[], ...this.curves]);
  }

  clear(): void {
    this.time.length = 0;
    for (const one of this.curves) one.length = 0;
    setText(byId("exponent-values"), "");
    this.dirty = true;
  }

  take({ time, exponents, done }: Exponents): void {
    if (this.time.length && time <= this.time[this.time.length - 1]) this.clear();
    this.time.push(time);
    for (let i = 0; i < MOST; i++) {
      const one = exponents[i];
      const error = one?.error ?? null;
      const of = [one?.value ?? null, one && error !== null ? one.value + error : null, one && error !== null ? one.value - error : null];
      of.forEach((value, k) => this.curves[PER_CURVE * i + k].push(value));
    }
    if (this.time.length > POINTS) for (const list of [this.time, ...this.curves]) thin(list);
    showKeys(byId("exponent-keys"), exponents.slice(0, MOST).map((_, i) => `*λ*_${i + 1}`));
    const first = exponents[0];
    const { time: unit } = units();
    if (first) setText(byId("exponent-values"), `\u03bb\u2081 = ${withError(first.value, first.error, unit ? `/${unit}` : "")}${done ? "" : " so far"}`);
    this.dirty = true;
  }

  private told(power: string, room: number): void {
    this.room = room;
    setText(byId("exponent-power"), power);
  }

  /** Room for the band but for its beginning, where it is as wide as it is meaningless; zero is always in sight. */
  private range(): [number, number] {
    let [low, high] = [0, 0];
    const from = this.time.findIndex((t) => t >= 0.2 * this.time[this.time.length - 1]);
    for (const one of this.curves) {
      for (let i = Math.max(0, from); i < one.length; i++) {
        low = Math.min(low, one[i] ?? 0);
        high = Math.max(high, one[i] ?? 0);
      }
    }
    return roomy(low, high, HEADROOM, LEAST);
  }

  draw(): void {
    if (!this.dirty) return;
    this.dirty = false;
    byId("exponents-empty").hidden = this.time.length > 0;
    this.plot.setData([this.time, ...this.curves]);
  }
}

/** The line that matters most. */
function zero(plot: uPlot): void {
  const y = plot.valToPos(0, "y", true);
  const { left, top, width, height } = plot.bbox;
  if (!(y > top && y < top + height)) return;
  plot.ctx.save();
  plot.ctx.strokeStyle = currentInks().muted;
  plot.ctx.beginPath();
  plot.ctx.moveTo(left, y);
  plot.ctx.lineTo(left + width, y);
  plot.ctx.stroke();
  plot.ctx.restore();
}

function thin<T>(list: T[]): void {
  let kept = 0;
  for (let i = 0; i < list.length; i += 2) list[kept++] = list[i];
  list.length = kept;
}

/** Speed, turning rate and shape over one time axis, with a common cursor. */

import type uPlot from "uplot";
import { byId, make, setText } from "../dom";
import { SHAPE, SPEED, T, TURNING, type History } from "../history";
import { pretty } from "../numbers";
import type { Observable } from "../protocol";
import { symbol } from "../symbols";
import { curve, DASHES } from "../theme";
import { axis, chart, linear, roomy } from "./chart";
import { showKeys } from "./keys";

/** Room above the curves of the shape for their keys. */
const HEADROOM = 0.45;
/** So large a share of the turning rates is usual; beyond so many times that begins a spike. */
const USUAL = 0.9;
const SPIKE = 6;
/** Points per curve, at most; and for each pixel of its width. */
const POINTS = 700;
const PER_PIXEL = 2.5;

interface Row {
  chart: uPlot;
  columns: number[];
  data: (number | null)[][];
}

export class SeriesStrip {
  private rows: Row[] = [];
  private readonly time: number[] = [];
  private readonly place = byId("series");

  /** `pointed` hears the time under the cursor. */
  constructor(
    private readonly history: History,
    private readonly pointed: (time: number | null) => void,
  ) {}

  /** New rows for the observables of a model. */
  begin(observables: Observable[]): void {
    for (const row of this.rows) row.chart.destroy();
    this.place.replaceChildren();
    const shape = observables.map((_, i) => SHAPE + i);
    this.rows = [
      this.row("speed", "|*v*|", [SPEED], false),
      this.row("turning rate", "*ω*", [TURNING], observables.length === 0),
      ...(observables.length ? [this.row("shape", "", shape, true, observables)] : []),
    ];
  }

  /** Shows the samples since `from`, up to `now`. */
  show(from: number, now: number): void {
    const first = this.history.since(from);
    const points = Math.min(POINTS, PER_PIXEL * (this.rows[0]?.chart.over.clientWidth ?? POINTS));
    const stride = Math.max(1, Math.ceil((this.history.length - first) / Math.max(2, points)));
    const start = this.history.start(first, stride);
    const count = Math.max(0, Math.ceil((this.history.length - start) / stride));
    this.time.length = count;
    for (let k = 0; k < count; k++) this.time[k] = this.history.at(start + k * stride, T);
    for (const row of this.rows) {
      row.columns.forEach((column, c) => this.fill(row.data[c], column, start, stride, count));
      row.chart.batch(() => {
        row.chart.setData([this.time, ...row.data], false);
        row.chart.setScale("x", { min: Math.max(from, count ? this.time[0] : from), max: Math.max(now, from + 1e-6) });
      });
    }
  }

  private fill(out: (number | null)[], column: number, start: number, stride: number, count: number): void {
    out.length = count;
    for (let k = 0; k < count; k++) {
      const value = column < this.history.columns ? this.history.at(start + k * stride, column) : NaN;
      out[k] = Number.isNaN(value) ? null : value;
    }
  }

  private row(name: string, markup: string, columns: number[], last: boolean, observables: Observable[] = []): Row {
    const headroom = observables.length ? HEADROOM : 0;
    const place = make("div", { class: "series-row" });
    const frame = make("div", { class: last ? "series-frame series-frame-last" : "series-frame" }, make("span", { class: "series-name", title: name }, symbol(markup)), place);
    if (observables.length) frame.append(keysOf(observables));
    if (last) frame.append(make("span", { class: "series-time", title: "model time" }, symbol("*t*")));
    this.place.append(frame);
    const made = chart(place, `${name} against time`, {
      cursor: { sync: { key: "time" }, points: { show: false }, y: false, drag: { x: false, y: false } },
      scales: { x: { time: false, auto: false }, y: { range: (plot, low, high) => (columns[0] === TURNING ? calm(plot.data[1], low, high) : roomy(low, high, headroom)) } },
      padding: [4, 14, last ? 0 : 3, 0],
      axes: [
        axis({ ...linear(), size: last ? 20 : 0, show: last }),
        axis({ ...linear(3, headroom), size: 48 }),
      ],
      series: [{}, ...columns.map((_, i) => ({ stroke: () => curve(i), dash: DASHES[i], width: 1.5, points: { show: false } }))],
      hooks: { setCursor: [(plot: uPlot) => this.cursor(plot)] },
    }, [[], ...columns.map(() => [])]);
    return { chart: made, columns, data: columns.map(() => []) };
  }

  /** The values under the cursor, in the head of the strip. */
  private cursor(plot: uPlot): void {
    if (plot !== this.rows[0]?.chart) return;
    const index = plot.cursor.idx;
    const t = index === null || index === undefined ? undefined : this.time[index];
    this.pointed(t ?? null);
    const say = (i: number): string => pretty((index === null || index === undefined ? null : this.rows[i].data[0][index]) ?? NaN, 3);
    setText(byId("series-values"), t === undefined ? "model time" : `t ${pretty(t, 5)} \u2002|v| ${say(0)} \u2002\u03c9 ${say(1)}`);
  }
}

/** The range of a rate that diverges where the body nearly rests: such spikes leave the picture, or all else were flat. */
function calm(values: ArrayLike<number | null | undefined>, low: number | null, high: number | null): [number, number] {
  const sizes = Array.from(values, (value) => Math.abs(value ?? 0)).sort((a, b) => a - b);
  const usual = sizes[Math.floor(USUAL * sizes.length)] ?? 0;
  if (low === null || high === null || !(usual > 0)) return roomy(low, high, 0);
  return roomy(Math.max(low, -SPIKE * usual), Math.min(high, SPIKE * usual), 0);
}

function keysOf(observables: Observable[]): HTMLElement {
  const keys = make("span", { class: "keys" });
  showKeys(keys, observables.map((one) => one.symbol), observables.map((one) => one.meaning));
  return make("div", { class: "plot-keys" }, keys);
}

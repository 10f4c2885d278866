/** Speed, turning rate and shape over one time axis, with a common cursor. */

import type uPlot from "uplot";
import { byId, make, setText } from "../dom";
import { SHAPE, SPEED, T, TURNING, type History } from "../history";
import { pretty } from "../numbers";
import type { Observable } from "../protocol";
import { symbol } from "../symbols";
import { curve, DASHES } from "../theme";
import { units, useUnits } from "../units";
import { across, axis, chart, roomy, upward } from "./chart";
import { showKeys } from "./keys";

/** Room above the curves of the shape for their keys. */
const HEADROOM = 0.45;
/** So large a share of the turning rates is usual; beyond so many times that begins a spike. */
const USUAL = 0.9;
const SPIKE = 6;
/** Points per curve, at most; and for each pixel of its width. */
const POINTS = 700;
const PER_PIXEL = 2.5;

/** Turning by less than this (rad) in all that is shown is rounding: a straight way. */
const NEGLIGIBLE = 1e-9;
/** Curves of the shape within this part of the radius of the body are flat. */
const FLAT = 1e-9;

/** Where a body has no turning rate. */
const NO_RATE = "none: at rest, or under noise that leaves the velocity no derivative";

interface Row {
  chart: uPlot;
  columns: number[];
  data: (number | null)[][];
  /** Room that its numbers take. */
  room: number;
  /** What is said where it has no curve. */
  empty: HTMLElement;
}

/** What a row is called, and its unit (see `units`). */
interface Name {
  name: string;
  unit: string;
}

export class SeriesStrip {
  private rows: Row[] = [];
  /** Room that the numbers of all rows take, for one time axis. */
  private room = 48;
  /** Radius of the body, and time that is shown. */
  private seen = { radius: 1, time: 0 };
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
    this.rows = [];
    this.place.replaceChildren();
    const shape = observables.map((_, i) => SHAPE + i);
    this.rows = [
      this.row({ name: "speed", unit: "speed" }, [SPEED], false),
      this.row({ name: "turning rate", unit: "turning" }, [TURNING], observables.length === 0),
      ...(observables.length ? [this.row({ name: "shape", unit: "length" }, shape, true, observables)] : []),
    ];
  }

  /** Shows the samples since `from`, up to `now`, of a body with this radius. */
  show(from: number, now: number, radius: number): void {
    const first = this.history.since(from);
    const points = Math.min(POINTS, PER_PIXEL * (this.rows[0]?.chart.over.clientWidth ?? POINTS));
    const stride = Math.max(1, Math.ceil((this.history.length - first) / Math.max(2, points)));
    const start = this.history.start(first, stride);
    const count = Math.max(0, Math.ceil((this.history.length - start) / stride));
    this.time.length = count;
    for (let k = 0; k < count; k++) this.time[k] = this.history.at(start + k * stride, T);
    this.seen = { radius, time: now - from };
    const { room } = this;
    for (const row of this.rows) {
      row.columns.forEach((column, c) => this.fill(row.data[c], column, start, stride, count));
      if (row.columns[0] === TURNING) this.told(row);
      row.chart.batch(() => {
        row.chart.setData([this.time, ...row.data], false);
        row.chart.setScale("x", { min: Math.max(from, count ? this.time[0] : from), max: Math.max(now, from + 1e-6) });
      });
    }
    if (this.room !== room) for (const row of this.rows) row.chart.redraw(false, true);
  }

  /** The rate of a straight way is 0; where no sample has one, it is said why. */
  private told({ data: [rates], empty }: Row): void {
    let [known, most] = [0, 0];
    for (const rate of rates) if (rate !== null) [known, most] = [known + 1, Math.max(most, Math.abs(rate))];
    if (most * this.seen.time < NEGLIGIBLE) rates.forEach((rate, k) => (rates[k] = rate === null ? null : 0));
    empty.hidden = known > 0 || rates.length === 0;
  }

  private fill(out: (number | null)[], column: number, start: number, stride: number, count: number): void {
    out.length = count;
    for (let k = 0; k < count; k++) {
      const value = column < this.history.columns ? this.history.at(start + k * stride, column) : NaN;
      out[k] = Number.isNaN(value) ? null : value;
    }
  }

  private row(name: Name, columns: number[], last: boolean, observables: Observable[] = []): Row {
    const headroom = observables.length ? HEADROOM : 0;
    const place = make("div", { class: "series-row" });
    const power = make("span", { class: "series-power" });
    const label = make("span", { class: "series-name" }, make("span", {}, name.name), power, make("span", { "data-unit": name.unit }));
    const empty = make("p", { class: "series-empty", hidden: "" }, NO_RATE);
    const frame = make("div", { class: last ? "series-frame series-frame-last" : "series-frame" }, label, place, empty);
    if (observables.length) frame.append(keysOf(observables));
    if (last) frame.append(make("span", { class: "series-time" }, symbol("*t*"), make("span", { "data-unit": "in-time" })));
    this.place.append(frame);
    useUnits(units(), frame);
    const made = { columns, data: columns.map(() => []), room: 0, empty };
    const told = (text: string, room: number): void => {
      setText(power, text);
      made.room = room;
      this.room = Math.max(made.room, ...this.rows.map((one) => one.room));
    };
    return Object.assign(made, { chart: this.chart(place, name.name, columns, last, headroom, told) });
  }

  private chart(place: HTMLElement, name: string, columns: number[], last: boolean, headroom: number, told: (power: string, room: number) => void): uPlot {
    return chart(place, `${name} against time`, {
      cursor: { sync: { key: "time" }, points: { show: false }, y: false, drag: { x: false, y: false } },
      scales: { x: { time: false, auto: false }, y: { range: (plot, low, high) => this.range(columns[0], headroom, plot.data[1], low, high) } },
      padding: [8, 14, last ? 0 : 3, 0],
      axes: [
        axis({ ...across(), size: last ? 20 : 0, show: last }),
        axis({ ...upward(3, headroom, told), size: () => this.room }),
      ],
      series: [{}, ...columns.map((_, i) => ({ stroke: () => curve(i), dash: DASHES[i], width: 1.5, points: { show: false } }))],
      hooks: { setCursor: [(plot: uPlot) => this.cursor(plot)] },
    }, [[], ...columns.map(() => [])]);
  }

  private range(column: number, headroom: number, values: ArrayLike<number | null | undefined>, low: number | null, high: number | null): [number, number] {
    if (column === TURNING) return calm(values, low, high);
    return roomy(low, high, headroom, FLAT * this.seen.radius);
  }

  /** The values under the cursor, in the head of the strip. */
  private cursor(plot: uPlot): void {
    if (plot !== this.rows[0]?.chart) return;
    const index = plot.cursor.idx;
    const t = index === null || index === undefined ? undefined : this.time[index];
    this.pointed(t ?? null);
    const say = (i: number): string => pretty((index === null || index === undefined ? null : this.rows[i].data[0][index]) ?? NaN, 3);
    setText(byId("series-values"), t === undefined ? "" : `t ${pretty(t, 5)} \u2002speed ${say(0)} \u2002turning ${say(1)}`);
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

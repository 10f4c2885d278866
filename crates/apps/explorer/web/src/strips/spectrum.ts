/** Power spectra of the motion since the last change, both axes logarithmic. */

import type uPlot from "uplot";
import { byId, setText } from "../dom";
import type { Strips } from "../protocol";
import { curve, DASHES } from "../theme";
import { axis, chart, powers } from "./chart";
import { showKeys } from "./keys";

/** Decades shown below the highest peak: what lies deeper is round-off. */
const DECADES = 12;
const CURVES = 6;
/** Power below this is no motion. */
const ROUND_OFF = 1e-20;
/** Decades above the highest peak for each line of keys, and how many keys a line has. */
const HEADROOM = 2;
const KEYS = 3;

export class SpectrumStrip {
  private readonly plot: uPlot;
  private keys = 0;

  constructor() {
    const indices = Array.from({ length: CURVES }, (_, i) => i);
    this.plot = chart(byId("spectrum"), "Power spectrum against frequency", {
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: {
        x: { time: false, distr: 3, range: (_plot, low, high) => (high > low ? [low, high] : [0.01, 1]) },
        y: { distr: 3, range: (_plot, low, high) => (high > 0 ? [Math.max(low, high / 10 ** DECADES) / 2, high * 10 ** this.room()] : [1e-6, 1]) },
      },
      padding: [10, 14, 0, 0],
      axes: [axis({ ...powers(4), size: 20 }), axis({ ...powers(4), size: 40 })],
      series: [{}, ...indices.map((i) => ({ stroke: () => curve(i), dash: DASHES[i], width: 1.4, points: { show: false } }))],
    }, [[], ...indices.map(() => [])]);
  }

  private room(): number {
    return HEADROOM * Math.max(1, Math.ceil(this.keys / KEYS));
  }

  show({ frequencies, spectra }: Strips): void {
    const from = frequencies.findIndex((f) => f > 0);
    const peak = Math.max(0, ...spectra.map((one) => one.power.reduce((most, p) => Math.max(most, p), 0)));
    const enough = from >= 0 && frequencies.length - from > 1;
    const usable = enough && peak > ROUND_OFF;
    byId("spectrum-empty").hidden = usable;
    setText(byId("spectrum-empty"), enough ? "steady: no fluctuations" : "collecting samples\u2026");
    const shown = usable ? spectra.slice(0, CURVES) : [];
    this.keys = shown.length;
    const powers = Array.from({ length: CURVES }, (_, i) => shown[i]?.power.slice(from).map((p) => (p > 0 ? p : null)) ?? []);
    const x = usable ? frequencies.slice(from) : [];
    this.plot.setData([x, ...powers.map((power) => (power.length ? power : x.map(() => null)))]);
    showKeys(byId("spectrum-keys"), shown.map((one) => one.symbol), shown.map((one) => one.name));
  }
}

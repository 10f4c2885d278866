/** What all curve charts share: colours of the theme, true minus signs, fixed margins, size of their place. */

import uPlot from "uplot";
import { minus, pretty, ticks } from "../numbers";
import { UI_FONT } from "../plot";
import { currentInks, onTheme } from "../theme";

const FONT = `11px ${UI_FONT}`;

/** An axis in the colours of the theme. */
export function axis(options: Partial<uPlot.Axis>): uPlot.Axis {
  return {
    stroke: () => currentInks().muted,
    grid: { stroke: () => currentInks().faint, width: 1 },
    ticks: { stroke: () => currentInks().faint, width: 1, size: 4 },
    font: FONT,
    gap: 3,
    ...options,
  };
}

/** Pixels per number along the lower axis. */
const SPACING = 58;

/** Numbers of a linear axis, none in the room `above`; without a target as many as the width of the chart has room for. */
export function linear(target?: number, above = 0): Pick<uPlot.Axis, "splits" | "values"> {
  return {
    splits: (chart, _axis, low, high) => {
      const top = high - (above / (1 + above)) * (high - low);
      return high > low ? ticks(low, top, target ?? Math.max(2, chart.width / SPACING)).values : [low];
    },
    values: (_chart, splits) => splits.map((value) => pretty(value, 6)),
  };
}

/** Relative changes below this look like what they are: none. */
const STEADY = 0.05;

/** The range of data with some room, and more above; a constant gets a little, too. */
export function roomy(low: number | null, high: number | null, above: number, least = 1e-9): [number, number] {
  if (low === null || high === null) return [0, 1];
  const span = Math.max(high - low, STEADY * Math.max(Math.abs(low), Math.abs(high)), least);
  return [low - 0.06 * span, high + (0.06 + above) * span];
}

/** Powers of ten along a logarithmic axis, as many as have room. */
export function powers(most: number): Pick<uPlot.Axis, "splits" | "values" | "filter"> {
  return {
    splits: (_chart, _axis, low, high) => powersWithin(low, high, most),
    filter: (_chart, splits) => splits,
    values: (_chart, splits) => splits.map(power),
  };
}

function powersWithin(low: number, high: number, most: number): number[] {
  const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  if (!(last >= first)) return [low];
  const step = Math.ceil((last - first + 1) / most);
  const from = Math.ceil(first / step) * step;
  return Array.from({ length: Math.floor((last - from) / step) + 1 }, (_, i) => 10 ** (from + i * step));
}

function power(value: number): string {
  const exponent = Math.round(Math.log10(value));
  if (exponent >= -1 && exponent <= 2) return minus(String(10 ** exponent));
  return `10${[...String(exponent)].map((c) => (c === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(c)])).join("")}`;
}

/** A chart called `name` that fills `place` and follows its size and the theme, until it is destroyed. */
export function chart(place: HTMLElement, name: string, options: Omit<uPlot.Options, "width" | "height">, data: uPlot.AlignedData): uPlot {
  const leave = (): void => {
    observer.disconnect();
    forget();
  };
  const hooks = { ...options.hooks, destroy: [leave] };
  const size = { width: Math.max(40, place.clientWidth), height: Math.max(30, place.clientHeight) };
  const made = new uPlot({ legend: { show: false }, ...options, hooks, ...size }, data, place);
  made.root.setAttribute("role", "img");
  made.root.setAttribute("aria-label", name);
  for (const canvas of made.root.querySelectorAll("canvas")) canvas.setAttribute("aria-hidden", "true");
  const observer = new ResizeObserver(() => {
    if (place.clientWidth && place.clientHeight) made.setSize({ width: place.clientWidth, height: place.clientHeight });
  });
  observer.observe(place);
  const forget = onTheme(() => made.redraw(false));
  return made;
}

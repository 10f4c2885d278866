/** What all curve charts share: colours of the theme, true minus signs, fixed margins, size of their place. */

import uPlot from "uplot";
import { labelled, pretty, tenTo, ticks } from "../numbers";
import { UI_FONT } from "../plot";
import { textWidth } from "../symbols";
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

/** Numbers of an axis across: as many as the width of the chart has room for. */
export function across(): Pick<uPlot.Axis, "splits" | "values"> {
  return {
    splits: (chart, _axis, low, high) => (high > low ? ticks(low, high, Math.max(2, chart.width / SPACING)).values : [low]),
    values: (_chart, splits) => splits.map((value) => pretty(value, 6)),
  };
}

/** Least width of the numbers of an upward axis; and what ticks take beside them. */
const LEAST = 44;
const BESIDE = 12;

/** Numbers of an upward axis, none in the room `above`; `told` hears their common power of ten, and the room that they take. */
export function upward(target: number, above: number, told: (power: string, room: number) => void): Pick<uPlot.Axis, "splits" | "values"> {
  return {
    splits: (_chart, _axis, low, high) => (high > low ? ticks(low, high - (above / (1 + above)) * (high - low), target).values : [low]),
    values: (_chart, splits) => {
      const { labels, power } = labelled(splits, splits.length > 1 ? splits[1] - splits[0] : Math.abs(splits[0]) || 1);
      told(power ? tenTo(power) : "", Math.max(LEAST, ...labels.map((label) => textWidth(label, FONT) + BESIDE)));
      return labels;
    },
  };
}

/** Relative changes below this look like what they are: none. */
const STEADY = 0.05;

/** The range of data with some room, and more above; a constant gets a little, too, and what is 0 the range about it. */
export function roomy(low: number | null, high: number | null, above: number, least = 0): [number, number] {
  if (low === null || high === null) return [0, 1];
  const span = Math.max(high - low, STEADY * Math.max(Math.abs(low), Math.abs(high)), least) || 1;
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
  if (exponent >= -1 && exponent <= 2) return String(10 ** exponent);
  return tenTo(exponent);
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

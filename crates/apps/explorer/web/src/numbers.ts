/** Numbers for people: ticks, digits, true minus signs. */

const MINUS = "\u2212";

/** `text` with true minus signs. */
export function minus(text: string): string {
  return text.replaceAll("-", MINUS);
}

/** A number with at most `digits` significant digits, no trailing zeros, a true minus. */
export function pretty(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "\u2013";
  const text = Math.abs(value) >= 1e5 ? String(value.toExponential(digits - 1)).replace(/\.?0*e/, "e") : plain(value, digits);
  return minus(text).replace(/e\+?(.+)$/, (_, power: string) => `\u00b7${superscript(10, power)}`);
}

function superscript(base: number, power: string): string {
  const raised = [...power].map((c) => (c === MINUS ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(c)]));
  return `${base}${raised.join("")}`;
}

/** The same in ASCII, for inputs and addresses. */
export function plain(value: number, digits = 6): string {
  return String(Number(value.toPrecision(digits)));
}

/** A fixed number of decimals, a true minus, no minus zero. */
export function fixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return minus(Number(text) === 0 ? text.replace("-", "") : text);
}

/** The largest of 1, 2, 5 times a power of ten that is not above `value`. */
export function roundStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const mantissa = value / power;
  return power * (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1);
}

/** Decimals that tell multiples of `step` apart. */
export function decimalsOf(step: number): number {
  return Math.min(12, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

/** Round values along an axis and their labels. */
export interface Ticks {
  values: number[];
  labels: string[];
}

/** Ticks in steps of 1, 2 or 5 times a power of ten, at most about `target`. */
export function ticks(low: number, high: number, target: number): Ticks {
  const rough = (high - low) / Math.max(1, target);
  let step = roundStep(rough);
  if (step < rough * 0.999) step = roundStep(step * 2.6);
  const values: number[] = [];
  const first = Math.ceil(low / step - 1e-9);
  for (let k = first; k * step <= high + 1e-9 * step && values.length < 50; k++) values.push(k * step);
  const decimals = decimalsOf(step);
  const largest = Math.max(Math.abs(low), Math.abs(high));
  const label = largest >= 1e5 || largest < 1e-3 ? (v: number) => pretty(v, 3) : (v: number) => fixed(v, decimals);
  return { values, labels: values.map(label) };
}

/** Seconds as people say them. */
export function duration(seconds: number): string {
  if (seconds < 1) return "< 1 s";
  if (seconds < 90) return `${Math.round(seconds)} s`;
  return `${Math.round(seconds / 60)} min`;
}

/** The server's plain sentences with the signs that people write. */
export function typeset(text: string): string {
  return text
    .replaceAll("+-", "\u00b1")
    .replace(/\blambda_(\d)/g, (_, digit: string) => `\u03bb${String.fromCharCode(0x2080 + Number(digit))}`)
    .replace(/\blambda_([+-])/g, (_, sign: string) => `\u03bb${sign === "+" ? "\u208a" : "\u208b"}`)
    .replace(/\d+(\.\d+)?e-?\d+/g, (number) => pretty(Number(number), 5))
    .replace(/(^|[\s(=,])-(?=[\d.])/g, `$1${MINUS}`);
}

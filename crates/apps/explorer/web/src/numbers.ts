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
  return text.replace(/e\+?(.+)$/, (_, power: string) => `\u00b7${tenTo(Number(power))}`).replace("-", MINUS);
}

/** A power of ten. */
export function tenTo(power: number): string {
  return `10${[...String(power)].map((c) => (c === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(c)])).join("")}`;
}

/** Numbers from here to there are written without a power of ten: as along the axes of figures. */
const PLAIN = { least: 1e-3, most: 1e5 };

/** The power of ten that numbers up to this size have in common; 0 where they are written out. */
function commonPower(largest: number): number {
  return largest > 0 && (largest < PLAIN.least || largest >= PLAIN.most) ? Math.floor(Math.log10(largest) + 1e-9) : 0;
}

/** Digits of an error. */
const ERROR_DIGITS = 2;
/** A value beyond so many of its errors is known to all digits that are shown of any. */
const CERTAIN = 1e6;

/** `0.123 ± 0.012`: the error to two digits, the value to the same place; without an error the value to four. */
export function withError(value: number, error: number | null, unit = ""): string {
  if (error === null || !(error > 0) || Math.abs(value) > CERTAIN * error) return error === null ? `${pretty(value)}${unit}` : `${pretty(value)} \u00b1 ${pretty(error)}${unit}`;
  const rounded = Number(error.toPrecision(ERROR_DIGITS));
  const place = Math.floor(Math.log10(rounded) + 1e-9) - (ERROR_DIGITS - 1);
  const largest = Math.max(Math.abs(value), rounded);
  const power = place < -6 || largest >= PLAIN.most ? commonPower(largest) : 0;
  const [low, high] = [value, rounded].map((one) => fixed(one / 10 ** power, Math.max(0, power - place)));
  const text = `${low} \u00b1 ${high}`;
  return power ? `(${text})\u00b7${tenTo(power)}${unit}` : unit ? `(${text})${unit}` : text;
}

/** As many digits as a field for so many characters holds: written out, or with a power of ten where that holds more. */
export function fitting(value: number, characters: number): string {
  for (let digits = 8; digits > 1; digits--) {
    const short = Number(value.toPrecision(digits));
    const texts = [String(short), short.toExponential().replace("e+", "e")];
    const fits = texts.find((text) => text.length <= characters);
    if (fits !== undefined) return fits;
  }
  return plain(value, 1);
}

/** The same in ASCII, for inputs and addresses. */
export function plain(value: number, digits = 6): string {
  return String(Number(value.toPrecision(digits)));
}

/** A number that was given, or follows from given ones, without the digits of round-off: 0.475 for 0.47500000000000003. */
export function given(value: number): string {
  const short = Number(value.toPrecision(12));
  return String(Math.abs(short - value) <= 4 * Number.EPSILON * Math.abs(value) ? short : value);
}

/** A name of tables and options as people write it: `pulsating straight` for `pulsating-straight`. */
export function inWords(name: string): string {
  return ["quasi-periodic", "blow-up"].some((known) => name.startsWith(known)) ? name : name.replaceAll("-", " ");
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

/** Round values along an axis, their labels, and the power of ten that the labels leave out. */
export interface Ticks {
  values: number[];
  labels: string[];
  power: number;
}

/** The name of an axis with the power of ten of its ticks, before its unit: `*x* (10^{4} s)`. */
export function scaledLabel(name: string, unit: string | null, power: number): string {
  const all = [...(power ? [`10^{${power}}`] : []), ...(unit ? [unit] : [])].join(" ");
  return all ? `${name} (${all})` : name;
}

/** Ticks in steps of 1, 2 or 5 times a power of ten, at most about `target`. */
export function ticks(low: number, high: number, target: number): Ticks {
  const rough = (high - low) / Math.max(1, target);
  let step = roundStep(rough);
  if (step < rough * 0.999) step = roundStep(step * 2.6);
  const values: number[] = [];
  const first = Math.ceil(low / step - 1e-9);
  for (let k = first; k * step <= high + 1e-9 * step && values.length < 50; k++) values.push(k * step);
  return labelled(values, step);
}

/** Ticks at multiples of a step. */
export function labelled(values: number[], step: number): Ticks {
  const power = commonPower(Math.max(step, ...values.map(Math.abs)));
  const decimals = decimalsOf(step / 10 ** power);
  return { values, labels: values.map((value) => fixed(value / 10 ** power, decimals)), power };
}

/** Seconds as people say them. */
export function duration(seconds: number): string {
  if (seconds < 1) return "< 1 s";
  if (seconds < 90) return `${Math.round(seconds)} s`;
  return `${Math.round(seconds / 60)} min`;
}

/** The server's plain sentences with the signs that people write, and the unit of its times where they have one. */
export function typeset(text: string, time: string | null = null): string {
  return text
    .replace(/\b(period|a time of) \d+(\.\d+)?(e-?\d+)?/g, (found) => (time ? `${found} ${time}` : found))
    .replaceAll("+-", "\u00b1")
    .replace(/\blambda_(\d)/g, (_, digit: string) => `\u03bb${String.fromCharCode(0x2080 + Number(digit))}`)
    .replace(/\blambda_([+-])/g, (_, sign: string) => `\u03bb${sign === "+" ? "\u208a" : "\u208b"}`)
    .replace(/\d+(\.\d+)?e-?\d+/g, (number) => pretty(Number(number), 5))
    .replace(/(^|[\s(=,])-(?=[\d.])/g, `$1${MINUS}`);
}

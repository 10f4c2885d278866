/** The equations of a model, set as in the paper from the plain text of the registry: one paragraph each, broken between terms. */

import { make } from "./dom";
import type { Model } from "./protocol";
import { symbol } from "./symbols";

/** Names that are no parameters. */
const SIGNS: Record<string, string> = { pi: "*\u03c0*", delta: "*\u03b4*", phi: "*\u03d5*", theta: "*\u03b8*", int: "\u222b", ds: "d*s*", R0: "*R*_0" };

/** `(V) dv/dt = ...`: what comes before the equation. */
const LABEL = /^\(([A-Z]+)\)\s*/;
/** Between terms: a sum, a difference, an equation; a line may break before it. */
const BETWEEN = / (?=[-+=] )/;
/** A derivative; a power; a name with what stands below it; anything else. */
const TOKENS = /d([A-Za-z]\d*)(?:_([a-z]+))?\/dt|\^(-?\w+)|([A-Za-z][A-Za-z0-9]*)((?:_[A-Za-z0-9]+)*)|([^A-Za-z^]+)/g;

/** Paragraphs: one for each line of the text, its label in front. */
export function equations({ equations, parameters }: Model): HTMLElement {
  const symbols = new Map(parameters.map((one) => [one.name, one.symbol]));
  return make("div", { class: "equation-list" }, ...equations.split("\n").map((line) => paragraph(line.trim(), symbols)));
}

function paragraph(line: string, symbols: Map<string, string>): HTMLElement {
  const label = LABEL.exec(line)?.[1];
  const terms = line.replace(LABEL, "").split(BETWEEN);
  const parts = terms.flatMap((term, i) => [...(i ? [" "] : []), formula(term, symbols)]);
  return make("p", { class: label ? "equation" : "equation equation-note" }, ...(label ? [make("span", { class: "equation-label" }, `(${label})`)] : []), ...parts);
}

/** One term, never broken if it is a formula; words may be. */
function formula(text: string, symbols: Map<string, string>): HTMLElement {
  const words = / [a-z]{2,} [a-z]{2,}/.test(text);
  return make("span", words ? {} : { class: "term" }, ...[...text.matchAll(TOKENS)].map((token) => element(token, symbols)));
}

function element([all, rate, index, power, name, below, other]: RegExpMatchArray, symbols: Map<string, string>): Node {
  if (rate) return symbol(`d*${rate[0]}*${index ? `_{*${index}*}` : rate.length > 1 ? `_${rate.slice(1)}` : ""}/d*t*`);
  if (power) return make("sup", {}, named(power.replace("-", ""), power.startsWith("-") ? "\u2212" : "", symbols));
  if (name) return symbols.has(all) ? factor(symbols.get(all) ?? "") : below ? symbol(`${SIGNS[name] ?? `*${name}*`}_{*${below.slice(1)}*}`) : named(name, "", symbols);
  return document.createTextNode(other.replaceAll("<=", "\u2264").replaceAll("..", "\u2026").replaceAll("*", "\u2009").replace(/(^|[ (])-/g, "$1\u2212"));
}

/** A parameter; a quotient in brackets, for other factors may follow. */
function factor(markup: string): HTMLElement {
  return symbol(markup.includes("/") ? `(${markup})` : markup);
}

/** A parameter, a sign, a single letter of mathematics, or a word. */
function named(name: string, sign: string, symbols: Map<string, string>): HTMLElement {
  const letter = name.replace(/^([A-Za-z])(\d*)$/, (_, one: string, below: string) => (below ? `*${one}*_${below}` : `*${one}*`));
  return symbol(sign + (symbols.get(name) ?? SIGNS[name] ?? letter));
}

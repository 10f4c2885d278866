/**
 * Symbols: `*x*` italic, `_2` or `_{max}` subscript, `^2` superscript, a backslash takes the next character literally.
 * The same markup as in the figures, for the document and for canvases.
 */

import { make } from "./dom";
import type { Parameter } from "./protocol";

type Script = "base" | "sub" | "sup";

interface Run {
  text: string;
  italic: boolean;
  script: Script;
}

const cache = new Map<string, Run[]>();

/** Reads the markup into runs of equal setting; a mark without partner is dropped. */
function parse(markup: string): Run[] {
  const known = cache.get(markup);
  if (known) return known;
  const runs: Run[] = [];
  let italic = false;
  let script: Script = "base";
  let braced = false;
  for (let i = 0; i < markup.length; i++) {
    let c = markup[i];
    if (c === "*") {
      italic = !italic;
      continue;
    }
    if ((c === "_" || c === "^") && script === "base") {
      script = c === "_" ? "sub" : "sup";
      braced = markup[i + 1] === "{";
      if (braced) i++;
      continue;
    }
    if (c === "}" && braced) {
      script = "base";
      braced = false;
      continue;
    }
    if (c === "\\") c = markup[++i] ?? "";
    const last = runs.at(-1);
    if (last && last.italic === italic && last.script === script) last.text += c;
    else runs.push({ text: c, italic, script });
    if (!braced) script = "base";
  }
  cache.set(markup, runs);
  return runs;
}

/** A hyphen before a digit becomes a true minus, unless it follows a letter or a digit: as in the figures. */
function signed(text: string): string {
  return text.replace(/(?<![\p{L}\p{N}])-(?=[\d.])/gu, "\u2212");
}

/** The symbol without its setting: for titles, options and screen readers. */
export function spoken(markup: string): string {
  return parse(markup).map((run) => run.text).join("");
}

/** The symbol as elements. */
export function symbol(markup: string): HTMLElement {
  const out = document.createElement("span");
  out.className = "symbol";
  for (const run of parse(markup)) {
    let node: Node = document.createTextNode(signed(run.text));
    if (run.italic) node = wrapped("i", node);
    if (run.script !== "base") node = wrapped(run.script, node);
    out.append(node);
  }
  return out;
}

/** A parameter in a list: as short as its symbol; its name and meaning are told where one points. */
export function symbolOption({ name, symbol: markup, meaning }: Parameter): HTMLOptionElement {
  const lowered = (text: string): string => text.replace(/\d/g, (digit) => String.fromCharCode(0x2080 + Number(digit)));
  const text = parse(markup).map((run) => (run.script === "sub" ? lowered(run.text) : run.text)).join("");
  return make("option", { value: name, title: `${name}: ${meaning}` }, text);
}

function wrapped(tag: string, child: Node): HTMLElement {
  const element = document.createElement(tag);
  element.append(child);
  return element;
}

const SERIF = '"STIX Two Text", Georgia, "Times New Roman", serif';

/** The width of each run. */
function widthsOf(g: CanvasRenderingContext2D, runs: Run[], size: number): number[] {
  return runs.map((run) => {
    g.font = font(run, size);
    return g.measureText(signed(run.text)).width;
  });
}

let ruler: CanvasRenderingContext2D | null = null;

/** What texts are measured with. */
function rule<T>(measure: (g: CanvasRenderingContext2D) => T, none: T): T {
  ruler ??= document.createElement("canvas").getContext("2d");
  return ruler ? measure(ruler) : none;
}

/** The width of a text, in pixels. */
export function textWidth(text: string, fontOfText: string): number {
  return rule((g) => {
    g.font = fontOfText;
    return g.measureText(text).width;
  }, 0);
}

/** The width of a symbol at this size, in pixels. */
export function symbolWidth(markup: string, size: number): number {
  return rule((g) => widthsOf(g, parse(markup), size).reduce((a, b) => a + b, 0), 0);
}

/** A name of an axis is set no smaller than this. */
const SMALLEST = 10;

/** The symbol for so much room: smaller where it is too wide, and at the smallest size cut, with an ellipsis. */
export function fittedSymbol(markup: string, size: number, room: number): { markup: string; size: number; width: number } {
  const width = symbolWidth(markup, size);
  if (width <= room) return { markup, size, width };
  const smaller = Math.max(SMALLEST, Math.floor((size * room) / width));
  let cut = markup;
  while (cut && symbolWidth(cut === markup ? cut : `${cut}\u2026`, smaller) > room) cut = cut.slice(0, -1);
  const fitted = cut === markup ? markup : `${cut}\u2026`;
  return { markup: fitted, size: smaller, width: symbolWidth(fitted, smaller) };
}

/** Draws the symbol on a canvas, centred about `x`, its baseline at `y`. */
export function drawSymbol(g: CanvasRenderingContext2D, markup: string, x: number, y: number, size: number): void {
  const runs = parse(markup);
  const widths = widthsOf(g, runs, size);
  g.textAlign = "left";
  let at = x - widths.reduce((a, b) => a + b, 0) / 2;
  runs.forEach((run, i) => {
    g.font = font(run, size);
    const drop = run.script === "sub" ? 0.22 : run.script === "sup" ? -0.36 : 0;
    g.fillText(signed(run.text), at, y + drop * size);
    at += widths[i];
  });
}

function font(run: Run, size: number): string {
  return `${run.italic ? "italic " : ""}${(run.script === "base" ? 1 : 0.74) * size}px ${SERIF}`;
}

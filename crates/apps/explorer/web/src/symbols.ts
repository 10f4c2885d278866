/**
 * Symbols: `*x*` italic, `_2` or `_{max}` subscript, `^2` superscript, a backslash takes the next character literally.
 * The same markup as in the figures, for the document and for canvases.
 */

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

function wrapped(tag: string, child: Node): HTMLElement {
  const element = document.createElement(tag);
  element.append(child);
  return element;
}

const SERIF = '"STIX Two Text", Georgia, "Times New Roman", serif';

/** Draws the symbol on a canvas, centred about `x`, its baseline at `y`. */
export function drawSymbol(g: CanvasRenderingContext2D, markup: string, x: number, y: number, size: number): void {
  const runs = parse(markup);
  const widths = runs.map((run) => {
    g.font = font(run, size);
    return g.measureText(signed(run.text)).width;
  });
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

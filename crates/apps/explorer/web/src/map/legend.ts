/** The legend of the map: the regimes that occur, and the lines of the theory. */

import { make } from "../dom";
import { swatch } from "../glyphs";
import type { Line, Regime } from "../protocol";
import { symbol } from "../symbols";
import { DASH } from "./painting";

const SVG = "http://www.w3.org/2000/svg";

export class Legend {
  private shown = "";

  constructor(private readonly element: HTMLElement) {}

  /** Shows these, and for a strip what is above it; nothing is touched where they are shown already. */
  show(regimes: Regime[], lines: Line[], strip: boolean): void {
    const key = JSON.stringify([strip, regimes.map((one) => one.name), lines.map((line) => [line.label, line.style])]);
    if (key === this.shown) return;
    this.shown = key;
    const distinct = lines.filter((line, i) => lines.findIndex((other) => other.label === line.label) === i);
    this.element.replaceChildren(
      ...regimes.map((regime) => make("li", { title: regime.meaning }, swatch(regime, 13), regime.words)),
      ...(strip ? [make("li", {}, symbol("*\u03bb*_1"), "largest Lyapunov exponent, bars: 95 %")] : []),
      ...distinct.map((line) => make("li", {}, sample(line), symbol(line.label))),
    );
  }
}

function sample(line: Line): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  for (const [name, value] of [["width", "26"], ["height", "10"], ["aria-hidden", "true"]]) svg.setAttribute(name, value);
  const stroke = document.createElementNS(SVG, "path");
  const attributes = { d: "M1 5H25", stroke: "currentColor", "stroke-width": "1.6", "stroke-dasharray": DASH[line.style]?.join(" ") || "none" };
  for (const [name, value] of Object.entries(attributes)) stroke.setAttribute(name, value);
  svg.append(stroke);
  return svg;
}

/** The legend of the branches: their motions, what lines mean, and the special points that occur. */

import { make } from "../dom";
import { marker, swatch } from "../glyphs";
import type { Regime } from "../protocol";
import { kindOf } from "./kinds";
import { STABLE, UNSTABLE } from "./painting";
import type { BranchSet } from "./set";

const SVG = "http://www.w3.org/2000/svg";

/** The legend of the diagram. */
export function showBranchLegend(element: HTMLElement, set: BranchSet | null, regimes: Regime[]): void {
  if (!set) return element.replaceChildren();
  const motions = regimes.filter((regime) => set.branches.some((branch) => branch.between.includes(regime.name)));
  element.replaceChildren(
    ...motions.map((regime) => make("li", { title: regime.meaning }, swatch(regime, 13), regime.words)),
    ...lines(set),
  );
}

/** The legend of the branches upon the map, whose colours are those of the map's own motions. */
export function showLegendOnMap(element: HTMLElement, set: BranchSet | null, others: (Node | string)[]): void {
  if (!set) return element.replaceChildren();
  element.replaceChildren(make("li", { title: "The branches lie side by side." }, ...(others.length ? ["branches ", make("span", {}, ...others), ":"] : ["branches:"])), ...lines(set));
}

/** Lines and markers. */
function lines(set: BranchSet): HTMLElement[] {
  const kinds = [...new Set(set.specials.map((special) => special.kind))].map(kindOf);
  return [
    make("li", { title: "Small deviations die out." }, sample(STABLE.width, STABLE.dash), "stable"),
    make("li", { title: "Small deviations grow: a simulation leaves this motion." }, sample(UNSTABLE.width, UNSTABLE.dash), "unstable"),
    ...kinds.map((kind) => make("li", { title: kind.meaning }, marker(kind.glyph, 13), kind.label)),
  ];
}

function sample(width: number, dash: number[]): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  for (const [name, value] of [["width", "26"], ["height", "10"], ["aria-hidden", "true"]]) svg.setAttribute(name, value);
  const stroke = document.createElementNS(SVG, "path");
  const attributes = { d: "M1 5H25", stroke: "currentColor", "stroke-width": String(width), "stroke-dasharray": dash.join(" ") || "none" };
  for (const [name, value] of Object.entries(attributes)) stroke.setAttribute(name, value);
  svg.append(stroke);
  return svg;
}

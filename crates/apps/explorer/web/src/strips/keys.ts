/** Keys of curves: a stroke in the curve's colour and dash, and its symbol. */

import { make } from "../dom";
import { symbol } from "../symbols";
import { curve, DASHES } from "../theme";

const SVG = "http://www.w3.org/2000/svg";

/** Shows one key per symbol; `index` of a curve is its place in the list. */
export function showKeys(place: HTMLElement, symbols: string[], titles: string[] = []): void {
  const id = symbols.join("\n");
  if (place.dataset.shown === id) return;
  place.dataset.shown = id;
  place.replaceChildren(...symbols.map((markup, i) => make("span", { class: "key", title: titles[i] ?? "" }, stroke(i), symbol(markup))));
}

/** The colours of keys follow the theme. */
export function recolourKeys(): void {
  for (const path of document.querySelectorAll<SVGElement>("[data-curve]")) path.setAttribute("stroke", curve(Number(path.dataset.curve)));
}

function stroke(index: number): SVGSVGElement {
  const svg = document.createElementNS(SVG, "svg");
  for (const [name, value] of [["width", "16"], ["height", "8"], ["aria-hidden", "true"]]) svg.setAttribute(name, value);
  const path = document.createElementNS(SVG, "path");
  const attributes = { d: "M0 4H16", stroke: curve(index), "stroke-width": "2", "stroke-dasharray": DASHES[index].join(" ") || "none", "data-curve": String(index) };
  for (const [name, value] of Object.entries(attributes)) path.setAttribute(name, value);
  svg.append(path);
  return svg;
}

/** One glyph for each regime, the shapes of the figures: a swatch of the regime's colour with its shape upon it. */

import type { Regime } from "./protocol";

const SVG = "http://www.w3.org/2000/svg";

/** A shape about the origin, as large as a disc of radius 1. */
interface Shape {
  path: string;
  filled: boolean;
}

const polygon = (radius: number, count: number, from: number): string =>
  `${Array.from({ length: count }, (_, i) => {
    const angle = from + (2 * Math.PI * i) / count;
    return `${i ? "L" : "M"}${(radius * Math.cos(angle)).toFixed(3)} ${(radius * Math.sin(angle)).toFixed(3)}`;
  }).join("")}Z`;

const arms = (radius: number, count: number, from: number): string =>
  Array.from({ length: count }, (_, i) => {
    const angle = from + (Math.PI * i) / count;
    const [c, s] = [(radius * Math.cos(angle)).toFixed(3), (radius * Math.sin(angle)).toFixed(3)];
    return `M${c} ${s}L${-Number(c)} ${-Number(s)}`;
  }).join("");

const circle = (r: number): string => `M${r} 0A${r} ${r} 0 1 1 ${-r} 0A${r} ${r} 0 1 1 ${r} 0Z`;

const SHAPES: Record<string, Shape> = {
  Disc: { path: circle(1), filled: true },
  Ring: { path: circle(0.92), filled: false },
  Triangle: { path: polygon(1.25, 3, -Math.PI / 2), filled: true },
  DownTriangle: { path: polygon(1.25, 3, Math.PI / 2), filled: true },
  Square: { path: polygon(1.27, 4, Math.PI / 4), filled: true },
  Diamond: { path: polygon(1.32, 4, 0), filled: true },
  Zigzag: { path: "M-1.5 .8L-.5 -.8L.5 .8L1.5 -.8", filled: false },
  Star: { path: arms(1.2, 3, Math.PI / 2), filled: false },
  Cross: { path: arms(1.2, 2, Math.PI / 4), filled: false },
  Plus: { path: arms(1.2, 2, 0), filled: false },
  Question: { path: "M-.62 -.55C-.6 -1.25 .68 -1.3 .68 -.5C.68 .1 0 .1 0 .6M0 1.1L0 1.25", filled: false },
};

const shapeOf = (regime: Regime): Shape => SHAPES[regime.glyph] ?? SHAPES.Question;

/** Size of a shape within the arrow of its sense. */
const WITHIN = 0.62;

/** The arrow about the shape of a motion by its sense: anticlockwise, its mirror image clockwise; y points down. */
const ARROW: Shape = { path: "M.94 .94A1.33 1.33 0 1 0 -1.25 .45M-1.85 .22L-1.25 .62L-.72 .1", filled: false };

const mirrored = (regime: Regime): number => (regime.hand === "Clockwise" ? -1 : 1);

/** Black or white, whichever stands out from the colour (relative luminance, WCAG 2). */
export function inkOn(colour: string): string {
  const channel = (at: number): number => {
    const value = parseInt(colour.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  };
  const luminance = 0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5);
  return luminance > 0.3 ? "#111111" : "#ffffff";
}

/** The swatch of a regime; without one an empty place of the same size. */
export function swatch(regime: Regime | null, size: number): SVGSVGElement {
  const svg = element("svg", { viewBox: "-2 -2 4 4", width: String(size), height: String(size), class: "swatch", "aria-hidden": "true" });
  const area = regime?.area ?? "none";
  svg.append(element("rect", { x: "-1.9", y: "-1.9", width: "3.8", height: "3.8", rx: "0.7", fill: area, class: "swatch-edge" }));
  if (regime) {
    const ink = inkOn(area);
    const draw = (shape: Shape, x: number, y: number): void =>
      svg.append(element("path", { d: shape.path, transform: `scale(${x} ${y})`, fill: shape.filled ? ink : "none", stroke: shape.filled ? "none" : ink, "stroke-width": "0.5", "stroke-linecap": "round" }));
    if (regime.hand === "Clockwise") svg.append(element("path", { d: "M-1.9 -.4L.4 1.9M-.4 -1.9L1.9 .4", stroke: "#ffffff", "stroke-width": "0.35" }));
    const size = regime.hand ? 0.82 * WITHIN : 0.82;
    draw(shapeOf(regime), size, size);
    if (regime.hand) draw(ARROW, 0.82 * mirrored(regime), 0.82);
  }
  return svg as SVGSVGElement;
}

function element(tag: string, attributes: Record<string, string>): SVGElement {
  const out = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) out.setAttribute(name, value);
  return out;
}

/** A marker of this shape, as in the figures. */
export function marker(glyph: string, size: number): SVGSVGElement {
  const svg = element("svg", { viewBox: "-2 -2 4 4", width: String(size), height: String(size), class: "swatch", "aria-hidden": "true" });
  const { path, filled } = SHAPES[glyph] ?? SHAPES.Question;
  svg.append(element("path", { d: path, fill: filled ? "currentColor" : "none", stroke: filled ? "none" : "currentColor", "stroke-width": "0.5", "stroke-linecap": "round" }));
  return svg as SVGSVGElement;
}

/** Draws a marker with a halo, so that it stands out from lines and areas. */
export function drawMarker(g: CanvasRenderingContext2D, glyph: string, [x, y]: [number, number], radius: number, ink: string, halo: string): void {
  const { path, filled } = SHAPES[glyph] ?? SHAPES.Question;
  const shape = new Path2D(path);
  g.save();
  g.translate(x, y);
  g.scale(radius, radius);
  g.lineJoin = g.lineCap = "round";
  g.strokeStyle = halo;
  g.lineWidth = filled ? 0.8 : 1.2;
  g.stroke(shape);
  g.fillStyle = g.strokeStyle = ink;
  g.lineWidth = 0.5;
  if (filled) g.fill(shape);
  else g.stroke(shape);
  g.restore();
}

/** Draws the shape upon an area of the regime's colour, within an arrow where the motion has a sense. */
export function drawGlyph(g: CanvasRenderingContext2D, regime: Regime, x: number, y: number, radius: number): void {
  g.save();
  g.translate(x, y);
  g.globalAlpha = 0.8;
  g.fillStyle = g.strokeStyle = inkOn(regime.area);
  const draw = ({ path, filled }: Shape, [across, upwards]: [number, number]): void => {
    g.save();
    g.scale(across * radius, upwards * radius);
    g.lineWidth = 0.45;
    const shape = new Path2D(path);
    if (filled) g.fill(shape);
    else g.stroke(shape);
    g.restore();
  };
  draw(shapeOf(regime), regime.hand ? [WITHIN, WITHIN] : [1, 1]);
  if (regime.hand) draw(ARROW, [mirrored(regime), 1]);
  g.restore();
}

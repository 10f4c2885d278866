/** The picture of the map: cells, hatching, lines of the theory, glyphs, the mark of the body, axes. */

import { drawGlyph } from "../glyphs";
import type { Line, LineStyle, Regime } from "../protocol";
import { drawAxes, pixelX, pixelY, type AxisLabel, type Box, type View } from "../plot";
import type { Inks } from "../theme";
import { units } from "../units";
import { divided, paintExponents, rangeOf } from "./exponents";
import type { Landmark } from "./landmarks";
import type { Lattice } from "./lattice";

/** The map before the present one, kept in sight until new cells cover it. */
export interface Memory {
  picture: HTMLCanvasElement;
  view: View;
  /** Whether it shows other parameters than the present ones. */
  outdated: boolean;
}

/** What fills the frame. */
export interface Areas {
  box: Box;
  view: View;
  regimes: Regime[];
  lattice: Lattice | null;
  memory: Memory | null;
}

/** The whole picture; `lanes`: the height of what lies between the strip and the exponents. */
export interface Scene extends Areas {
  labels: { x: AxisLabel; y: AxisLabel | null };
  landmarks: Landmark[];
  lanes: number;
  mark: { x: number; y: number };
}

export const DASH: Record<LineStyle, number[]> = {
  solid: [],
  dashed: [6, 4],
  dotted: [1.5, 3.5],
  "dash-dotted": [7, 3, 1.5, 3],
  "long-dashed": [12, 5],
};

/** Strength of a map of other parameters. */
const PALE = 0.45;

/** Draws the whole map; a strip has the exponents above it. */
export function paint(g: CanvasRenderingContext2D, scene: Scene, inks: Inks): void {
  const { box, view, labels } = scene;
  const { strip, above } = labels.y === null ? divided(box, scene.lanes) : { strip: box, above: null };
  const range = above && rangeOf(scene.lattice, view);
  clipped(g, strip, () => {
    paintAreas(g, { ...scene, box: strip }, inks);
    for (const line of scene.lattice?.start.lines ?? []) paintLine(g, box, view, line);
    paintGlyphs(g, { ...scene, box: strip });
  });
  if (above && range) clipped(g, above, () => paintExponents(g, above, range, scene.lattice, scene.regimes, inks));
  const at = markPixel(scene, strip);
  clipped(g, box, () => paintHairs(g, scene, at));
  drawAxes(g, strip, view, labels, inks);
  if (above && range) drawAxes(g, above, range, { x: null, y: { name: "*\u03bb*_1", unit: `1/${units().time ?? "time"}` } }, inks);
  paintRing(g, box, at);
}

/** Draws within a frame only. */
function clipped(g: CanvasRenderingContext2D, { left, top, width, height }: Box, draw: () => void): void {
  g.save();
  g.beginPath();
  g.rect(left, top, width, height);
  g.clip();
  draw();
  g.restore();
}

/** The areas upon their ground; a map of other parameters is pale. */
function paintAreas(g: CanvasRenderingContext2D, areas: Areas, inks: Inks): void {
  const { left, top, width, height } = areas.box;
  g.fillStyle = pattern(g, "ground", inks);
  g.fillRect(left, top, width, height);
  paintCells(g, areas, areas.memory?.outdated ? PALE : 1, inks);
}

/** Only what is known: the map before, the cells of now, hatching. */
export function paintCells(g: CanvasRenderingContext2D, { box, view, lattice, memory, regimes }: Areas, strength: number, inks: Inks): void {
  if (memory) {
    g.globalAlpha = strength;
    const [left, top] = [pixelX(box, view, memory.view.x0), pixelY(box, view, memory.view.y1)];
    g.imageSmoothingEnabled = false;
    g.drawImage(memory.picture, left, top, pixelX(box, view, memory.view.x1) - left, pixelY(box, view, memory.view.y0) - top);
    g.globalAlpha = 1;
  }
  if (!lattice) return;
  lattice.draw(g, box, view);
  regimes.forEach((regime, index) => {
    const kind = regime.glyph === "Question" ? "hatch" : regime.hand === "Clockwise" ? "falling" : null;
    const hatched = kind && lattice.outlineOf(index, box, view);
    if (!kind || !hatched) return;
    g.fillStyle = pattern(g, kind, inks);
    g.fill(hatched);
  });
}

const patterns = new Map<string, CanvasPattern>();

/** Dots for what is not computed yet, strokes for what stays undetermined, white ones that fall for what turns clockwise. */
function pattern(g: CanvasRenderingContext2D, kind: "ground" | "hatch" | "falling", inks: Inks): CanvasPattern | string {
  const key = `${kind} ${inks.ground}`;
  const known = patterns.get(key);
  if (known) return known;
  const tile = document.createElement("canvas");
  tile.width = tile.height = 8;
  const t = tile.getContext("2d");
  if (!t) return inks.ground;
  if (kind === "ground") {
    t.fillStyle = inks.ground;
    t.fillRect(0, 0, 8, 8);
    t.fillStyle = inks.line;
    t.fillRect(1, 1, 1.2, 1.2);
    t.fillRect(5, 5, 1.2, 1.2);
  } else {
    t.strokeStyle = kind === "hatch" ? "#888888" : "#ffffff";
    t.lineWidth = 1.1;
    t.beginPath();
    const [from, to] = kind === "hatch" ? [9, -1] : [-1, 9];
    for (const shift of [-8, 0, 8]) {
      t.moveTo(shift - 1, from);
      t.lineTo(shift + 9, to);
    }
    t.stroke();
  }
  const made = g.createPattern(tile, "repeat");
  if (!made) return inks.ground;
  patterns.set(key, made);
  return made;
}

/** A line of the theory: black with a white halo, visible upon every regime. */
function paintLine(g: CanvasRenderingContext2D, box: Box, view: View, line: Line): void {
  if (line.points.length < 2) return;
  const path = new Path2D();
  line.points.forEach(([x, y], i) => {
    const [u, v] = [pixelX(box, view, x), pixelY(box, view, y)];
    if (i) path.lineTo(u, v);
    else path.moveTo(u, v);
  });
  g.lineJoin = "round";
  g.strokeStyle = "rgba(255, 255, 255, 0.8)";
  g.lineWidth = 4;
  g.stroke(path);
  g.strokeStyle = "#111111";
  g.lineWidth = 1.6;
  g.setLineDash(DASH[line.style] ?? []);
  g.stroke(path);
  g.setLineDash([]);
}

function paintGlyphs(g: CanvasRenderingContext2D, { box, view, lattice, landmarks, regimes }: Scene): void {
  if (!lattice) return;
  for (const { regime, i, j } of landmarks) {
    const [left, top, width, height] = lattice.place(box, view, i, i + 1, j);
    if (regimes[regime]) drawGlyph(g, regimes[regime], left + width / 2, top + height / 2, 5);
  }
}

/** Where the body is. */
function markPixel({ box, view, mark, labels }: Scene, strip: Box): [number, number] {
  return [pixelX(box, view, mark.x), labels.y === null ? strip.top + strip.height / 2 : pixelY(box, view, mark.y)];
}

/** Radius of the ring about the body's place, and of the gap in the hair lines. */
const RING = 7;
const GAP = 11;

/** A cross of hair lines, light on dark on light; a strip has the upright one only. */
function paintHairs(g: CanvasRenderingContext2D, { box, labels }: Scene, [x, y]: [number, number]): void {
  const hairs = new Path2D();
  hairs.moveTo(x, box.top);
  hairs.lineTo(x, y - GAP);
  hairs.moveTo(x, y + GAP);
  hairs.lineTo(x, box.top + box.height);
  if (labels.y !== null) {
    hairs.moveTo(box.left, y);
    hairs.lineTo(x - GAP, y);
    hairs.moveTo(x + GAP, y);
    hairs.lineTo(box.left + box.width, y);
  }
  g.strokeStyle = "rgba(255, 255, 255, 0.45)";
  g.lineWidth = 2;
  g.stroke(hairs);
  g.strokeStyle = "rgba(0, 0, 0, 0.55)";
  g.lineWidth = 0.8;
  g.stroke(hairs);
}

/** The ring stays whole at the edge of the frame; outside there is none. */
function paintRing(g: CanvasRenderingContext2D, box: Box, [x, y]: [number, number]): void {
  const slack = 1;
  if (!(x >= box.left - slack && x <= box.left + box.width + slack && y >= box.top - slack && y <= box.top + box.height + slack)) return;
  const strokes: [string, number][] = [["rgba(255, 255, 255, 0.9)", 4], ["#111111", 1.6]];
  for (const [colour, width] of strokes) {
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.beginPath();
    g.arc(x, y, RING, 0, 2 * Math.PI);
    g.stroke();
  }
}

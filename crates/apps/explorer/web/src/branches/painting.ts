/** How branches are drawn: thick where stable, thin and dashed where unstable, with a marker at each special point. */

import { drawMarker } from "../glyphs";
import { pixelX, pixelY, type Box, type View } from "../plot";
import type { Plane, Regime, SpecialPoint } from "../protocol";
import { edge, visible } from "../theme";
import { divided } from "../map/exponents";
import { kindOf } from "./kinds";
import { isSpecial, type BranchSet, type Ordinate, type Spot } from "./set";

export const STABLE = { width: 3, dash: [] as number[] };
export const UNSTABLE = { width: 1.4, dash: [4, 2.5] };
/** Upon a map branches lie so many pixels apart, all at the same value of the other parameter. */
const APART = 5;
const MARKER = 4.2;

type ToPixel = (branch: number, at: [number, number]) => [number, number];

/** Draws all branches, the stable parts on top. */
export function paintBranches(g: CanvasRenderingContext2D, set: BranchSet, ordinate: Ordinate, toPixel: ToPixel, colour: (motion: string) => string, halo: string | null): void {
  g.lineJoin = "round";
  for (const stable of [false, true]) {
    const { width, dash } = stable ? STABLE : UNSTABLE;
    for (const number of set.branches.keys()) {
      for (const piece of set.pieces(number, ordinate)) {
        if (piece.stable !== stable) continue;
        const path = new Path2D();
        piece.points.forEach((at, i) => (i ? path.lineTo(...toPixel(number, at)) : path.moveTo(...toPixel(number, at))));
        if (halo) stroke(g, path, halo, width + 2, []);
        stroke(g, path, colour(piece.motion), width, dash);
      }
    }
  }
}

function stroke(g: CanvasRenderingContext2D, path: Path2D, colour: string, width: number, dash: number[]): void {
  g.strokeStyle = colour;
  g.lineWidth = width;
  g.setLineDash(dash);
  g.stroke(path);
  g.setLineDash([]);
}

/** Draws the special points. */
export function paintSpecials(g: CanvasRenderingContext2D, set: BranchSet, place: (special: SpecialPoint) => [number, number] | null, ink: string, halo: string): void {
  for (const special of set.specials) {
    const at = place(special);
    if (at) drawMarker(g, kindOf(special.kind).glyph, at, MARKER, ink, halo);
  }
}

/** A ring about a point. */
export function paintSelected(g: CanvasRenderingContext2D, [x, y]: [number, number], ink: string, halo: string): void {
  for (const [colour, width] of [[halo, 4], [ink, 1.8]] as [string, number][]) {
    g.beginPath();
    g.arc(x, y, 7.5, 0, 2 * Math.PI);
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.stroke();
  }
}

/** The colour of a motion. */
export function colourOf(regimes: Regime[]): (motion: string) => string {
  return (motion) => edge(visible(regimes.find((one) => one.name === motion)?.colour ?? "#888888"));
}

/** The height of a place for all branches side by side. */
export function lanesOf(set: BranchSet | null): number {
  return set ? APART * (set.branches.length + 1) : 0;
}

/** Where points of branches lie upon a map; `null` where the parameter followed is no axis of it. */
export function onMap(set: BranchSet, plane: Plane, box: Box, view: View): ((spot: Spot | SpecialPoint) => [number, number]) | null {
  const { along, parameters } = set.start;
  const value = (spot: Spot | SpecialPoint): number => (isSpecial(spot) ? spot.parameter : set.branches[spot.branch].parameter[spot.point]);
  if (plane.x.name === along.name) {
    const lanes = plane.y ? null : divided(box, lanesOf(set)).lanes;
    const base = lanes ? lanes.top + lanes.height - APART : pixelY(box, view, parameters[plane.y?.name ?? ""]);
    return (spot) => [pixelX(box, view, value(spot)), base - APART * spot.branch];
  }
  if (plane.y?.name !== along.name) return null;
  const base = pixelX(box, view, parameters[plane.x.name]);
  return (spot) => [base + APART * spot.branch, pixelY(box, view, value(spot))];
}

/** Draws the branches upon a map: lines at the value that the other parameter had, side by side. */
export function paintOnMap(g: CanvasRenderingContext2D, set: BranchSet, plane: Plane, box: Box, view: View, selected: Spot | null): void {
  const place = onMap(set, plane, box, view);
  if (!place) return;
  const across = plane.x.name === set.start.along.name;
  const toPixel: ToPixel = (branch, [parameter]) => {
    const [x, y] = place({ branch, point: 0 });
    return across ? [pixelX(box, view, parameter), y] : [x, pixelY(box, view, parameter)];
  };
  g.save();
  g.beginPath();
  g.rect(box.left, box.top, box.width, box.height);
  g.clip();
  paintBranches(g, set, "speed", toPixel, () => "#111111", "rgba(255, 255, 255, 0.85)");
  paintSpecials(g, set, place, "#111111", "#ffffff");
  if (selected) paintSelected(g, place(selected), "#111111", "#ffffff");
  g.restore();
}

/** Above a strip: the largest Lyapunov exponent along the only axis, with its 95 % interval; Fig. 4(b) of the paper. */

import { pixelX, pixelY, type Box, type View } from "../plot";
import type { Regime } from "../protocol";
import { edge, visible, type Inks } from "../theme";
import type { Lattice } from "./lattice";

/** The range is at least so wide. */
const LEAST = 0.02;
/** Room above and below, as a part of the range. */
const ROOM = 0.08;
const DOT = 2.4;

/** The strip of regimes below, a place for branches of this height upon it, and what is above. */
export function divided(box: Box, wanted: number): { strip: Box; lanes: Box; above: Box } {
  const height = Math.round(Math.min(40, 0.2 * box.height));
  const gap = 6;
  const free = box.height - height - gap;
  const lanes = Math.min(wanted, free / 2);
  return {
    strip: { ...box, top: box.top + box.height - height, height },
    lanes: { ...box, top: box.top + free - lanes + gap, height: lanes },
    above: { ...box, height: free - lanes },
  };
}

/** The range of all exponents and zero. */
export function rangeOf(lattice: Lattice | null, view: View): View {
  let [low, high] = [0, 0];
  for (const [i, value] of (lattice?.exponents ?? []).entries()) {
    if (!Number.isFinite(value)) continue;
    const error = lattice?.errors[i] || 0; // none where it is not known
    low = Math.min(low, value - error);
    high = Math.max(high, value + error);
  }
  if (high - low < LEAST) [low, high] = [Math.min(low, -LEAST / 2), Math.max(high, LEAST / 2)];
  const room = ROOM * (high - low);
  return { ...view, y0: low - room, y1: high + room };
}

/** One dot per cell in the colour of its regime, upon a line where the exponent vanishes. */
export function paintExponents(g: CanvasRenderingContext2D, box: Box, view: View, lattice: Lattice | null, regimes: Regime[], inks: Inks): void {
  g.fillStyle = inks.plot;
  g.fillRect(box.left, box.top, box.width, box.height);
  const zero = Math.round(pixelY(box, view, 0)) + 0.5;
  g.strokeStyle = inks.muted;
  g.lineWidth = 1;
  g.beginPath();
  g.moveTo(box.left, zero);
  g.lineTo(box.left + box.width, zero);
  g.stroke();
  if (!lattice) return;
  const { first, step } = lattice.start.x;
  for (const [i, value] of lattice.exponents.entries()) {
    const regime = regimes[lattice.regimes[i]];
    if (!Number.isFinite(value) || !regime) continue;
    const [x, error] = [pixelX(box, view, first + i * step), lattice.errors[i] || 0];
    g.strokeStyle = g.fillStyle = edge(visible(regime.colour));
    g.beginPath();
    g.moveTo(x, pixelY(box, view, value - error));
    g.lineTo(x, pixelY(box, view, value + error));
    g.stroke();
    g.beginPath();
    g.arc(x, pixelY(box, view, value), DOT, 0, 2 * Math.PI);
    g.fill();
  }
}

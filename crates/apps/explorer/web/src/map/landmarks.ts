/** Where the glyphs of a map go: deep inside each connected region, so that regions are told apart without colour. */

import { UNKNOWN, type Lattice } from "./lattice";

export interface Landmark {
  regime: number;
  i: number;
  j: number;
}

/** Regions thinner than this (cells) get no glyph. */
const DEPTH = 2.5;

/** The deepest cell of each region, by the distance to the nearest other cell (chessboard, two sweeps). */
export function landmarks(lattice: Lattice): Landmark[] {
  const { columns, rows, regimes } = lattice;
  const depth = depths(lattice);
  const seen = new Uint8Array(regimes.length);
  const out: Landmark[] = [];
  for (let start = 0; start < regimes.length; start++) {
    if (seen[start] || regimes[start] === UNKNOWN) continue;
    let best = start;
    const stack = [start];
    seen[start] = 1;
    for (let at = stack.pop(); at !== undefined; at = stack.pop()) {
      if (depth[at] > depth[best]) best = at;
      const i = at % columns;
      const next = [i > 0 ? at - 1 : at, i < columns - 1 ? at + 1 : at, at >= columns ? at - columns : at, at < columns * (rows - 1) ? at + columns : at];
      for (const to of next) {
        if (seen[to] || regimes[to] !== regimes[start]) continue;
        seen[to] = 1;
        stack.push(to);
      }
    }
    if (depth[best] >= (rows > 1 ? DEPTH : 1)) out.push({ regime: regimes[best], i: best % columns, j: Math.floor(best / columns) });
  }
  return out;
}

function depths({ columns, rows, regimes }: Lattice): Float32Array {
  const depth = new Float32Array(regimes.length);
  const sweep = (at: number, neighbours: [number, number][]): number => {
    const [i, j] = [at % columns, Math.floor(at / columns)];
    let least = Infinity;
    for (const [di, dj] of neighbours) {
      if (rows === 1 && dj) continue;
      const [u, v] = [i + di, j + dj];
      const inside = u >= 0 && u < columns && v >= 0 && v < rows;
      const same = inside && regimes[v * columns + u] === regimes[at];
      least = Math.min(least, same ? depth[v * columns + u] + Math.hypot(di, dj) : 1);
    }
    return least;
  };
  for (let at = 0; at < depth.length; at++) depth[at] = sweep(at, [[-1, 0], [0, -1], [-1, -1], [1, -1]]);
  for (let at = depth.length - 1; at >= 0; at--) depth[at] = Math.min(depth[at], sweep(at, [[1, 0], [0, 1], [1, 1], [-1, 1]]));
  return depth;
}

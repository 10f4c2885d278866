/** The branches so far, and what is asked of them. */

import type { Branch, BranchesStart, SpecialPoint } from "../protocol";

/** What the diagram shows against the parameter. */
export type Ordinate = "speed" | "period";

/** A point of a branch. */
export interface Spot {
  branch: number;
  point: number;
}

/** Whether a spot is a special point. */
export function isSpecial(spot: Spot | SpecialPoint): spot is SpecialPoint {
  return "kind" in spot;
}

/** A stretch of a branch over which motion and stability stay. */
export interface Piece {
  motion: string;
  stable: boolean;
  /** Parameter and value. */
  points: [number, number][];
}

export class BranchSet {
  readonly branches: Branch[] = [];
  specials: SpecialPoint[] = [];

  constructor(readonly start: BranchesStart) {}

  /** The connection at which a branch ends beyond this point, and its place there: where the parameter and the mean speed go to. */
  private beyond({ branch, point }: Spot, ordinate: Ordinate): [number, number] | null {
    const end = this.specials.find((one) => one.branch === branch && one.point === point && one.speed !== null);
    if (!end || end.speed === null) return null;
    return ordinate === "speed" ? [end.parameter, end.speed] : [end.parameter, this.branches[branch].period[point]];
  }

  /** Where a special point is drawn: a connection lies beyond the last point of its branch. */
  markAt(special: SpecialPoint, ordinate: Ordinate): [number, number] | null {
    return special.speed === null ? this.at(special, ordinate) : this.beyond(special, ordinate);
  }

  /** Parameter and value of a point; a motion that is steady has no period. */
  at({ branch, point }: Spot, ordinate: Ordinate): [number, number] | null {
    const of = this.branches[branch];
    const value = of?.[ordinate][point];
    return value === undefined || (ordinate === "period" && value === 0) ? null : [of.parameter[point], value];
  }

  /** A branch as it is drawn, from the special point where it begins to the connection at which it ends. */
  pieces(number: number, ordinate: Ordinate): Piece[] {
    const branch = this.branches[number];
    const all: Piece[] = [];
    let before = this.at({ branch: number, point: 0 }, ordinate);
    const birth = before && this.birth(branch, ordinate, before);
    if (birth && before && branch.stable.length) all.push({ motion: branch.between[0], stable: branch.stable[0], points: [birth, before] });
    for (const [k, stable] of branch.stable.entries()) {
      const next = this.at({ branch: number, point: k + 1 }, ordinate);
      const last = all.at(-1);
      if (before && next) {
        const motion = branch.between[k];
        if (last && last.motion === motion && last.stable === stable && last.points.at(-1) === before) last.points.push(next);
        else all.push({ motion, stable, points: [before, next] });
      }
      before = next;
    }
    this.extend(number, ordinate, all);
    return all;
  }

  /** Draws the first and the last piece on to the connections there. */
  private extend(number: number, ordinate: Ordinate, all: Piece[]): void {
    const last = this.branches[number].parameter.length - 1;
    const [start, end] = [0, last].map((point) => this.beyond({ branch: number, point }, ordinate));
    if (start) all[0]?.points.unshift(start);
    if (end && last > 0) all.at(-1)?.points.push(end);
  }

  /** Where a branch begins on another one; its period there is its own. */
  private birth(branch: Branch, ordinate: Ordinate, [, value]: [number, number]): [number, number] | null {
    const parent = branch.origin && this.branches[branch.origin[0]];
    if (!parent || !branch.origin) return null;
    const point = branch.origin[1];
    return [parent.parameter[point], ordinate === "speed" ? parent.speed[point] : value];
  }

  /** The special point here. */
  special({ branch, point }: Spot): SpecialPoint | null {
    return this.specials.find((one) => one.branch === branch && one.point === point) ?? null;
  }

  /** The point next to a pixel, at most `reach` pixels away; special points go first. */
  nearest(toPixel: (spot: Spot | SpecialPoint) => [number, number] | null, [px, py]: [number, number], reach: number): Spot | null {
    const far = (spot: Spot): number => {
      const at = toPixel(spot);
      return at ? Math.hypot(at[0] - px, at[1] - py) : Infinity;
    };
    const best = (spots: Iterable<Spot | SpecialPoint>): Spot | null => {
      let [least, found]: [number, Spot | null] = [reach, null];
      for (const spot of spots) {
        const distance = far(spot);
        if (distance < least) [least, found] = [distance, { branch: spot.branch, point: spot.point }];
      }
      return found;
    };
    return best(this.specials) ?? best(this.spots());
  }

  private *spots(): Generator<Spot> {
    for (const [branch, one] of this.branches.entries()) {
      for (let point = 0; point < one.parameter.length; point++) yield { branch, point };
    }
  }

  /** Motion at a point, and how many of its growth rates are above 0, and 0 within their errors. */
  state({ branch, point }: Spot): { motion: string; unstable: number; neutral: number } {
    const { motion, unstable, neutral } = this.branches[branch];
    return { motion: motion[point], unstable: unstable[point], neutral: neutral[point] };
  }
}

/** What is said of a point of a branch. */

import { make } from "../dom";
import { inWords, pretty } from "../numbers";
import type { Parameter } from "../protocol";
import { symbol } from "../symbols";
import { behind, ofSpeed, units } from "../units";
import { CRITICALITY, kindOf } from "./kinds";
import type { BranchSet, Spot } from "./set";

/** Its lines: what it is, and its numbers. */
export function describe(set: BranchSet, spot: Spot, parameter: Parameter): HTMLElement[] {
  const special = set.special(spot);
  const branch = set.branches[spot.branch];
  const period = special ? special.period : branch.period[spot.point] || null;
  const value = special?.parameter ?? branch.parameter[spot.point];
  const head = special ? kindOf(special.kind).label : motion(set.state(spot));
  const numbers = make("span", {}, symbol(parameter.symbol), ` = ${pretty(value, special ? 8 : 5)}`, period ? `, period ${pretty(period, 5)}${behind(units().time)}` : "", `, mean speed ${pretty(branch.speed[spot.point], 3)}${behind(ofSpeed(units()))}`);
  const lines = [make("b", {}, head), numbers];
  if (special?.criticality) lines.push(make("span", {}, CRITICALITY[special.criticality]));
  if (special?.breaks) lines.push(make("span", {}, special.breaks === "mirror" ? "the motions that begin turn left or right" : "the motions that begin have fewer axes"));
  lines.push(make("span", {}, where(spot.branch, special?.leads ?? null)));
  return lines;
}

/** Stable, or in how many directions deviations grow. */
function motion({ motion: name, unstable, neutral }: ReturnType<BranchSet["state"]>): string {
  const motion = inWords(name);
  const count = (n: number): string => (n === 1 ? "one direction" : `${n} directions`);
  if (unstable > 0) return `${motion}, unstable (deviations grow in ${count(unstable)})`;
  return neutral > 0 ? `${motion}, marginally stable (deviations neither grow nor die out in ${count(neutral)})` : `${motion}, stable`;
}

function where(branch: number, leads: number | null): string {
  return `on branch ${branch}` + (leads === null ? "" : `; branch ${leads} begins or lies here`);
}

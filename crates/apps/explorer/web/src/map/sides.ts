/** What may lie along an axis of the map: a parameter, or a coordinate of the start, which is treated like one. */

import type { Model, Parameter, Plane, Values } from "../protocol";

/** The window of a start that is chosen for the first time, and what no window exceeds. */
const RANGE: [number, number] = [-1, 1];
const ALLOWED: [number, number] = [-1e8, 1e8];

/** The coordinates of the start, as if they were parameters. */
export function starts(model: Model): Parameter[] {
  return model.coordinates.map(({ name, meaning }) => ({
    name,
    symbol: `${name}(0)`,
    default: 0,
    range: RANGE,
    allowed: ALLOWED,
    equation: "",
    meaning: `${meaning}, at the start`,
    whole: false,
  }));
}

/** Whether a name is a coordinate of the start, and no parameter. */
export function isStart(model: Model, name: string): boolean {
  return !model.parameters.some((one) => one.name === name) && model.coordinates.some((one) => one.name === name);
}

/** What this name means on an axis. */
export function side(model: Model, name?: string): Parameter | undefined {
  return [...model.parameters, ...starts(model)].find((one) => one.name === name);
}

/** Whether an axis of the plane is a coordinate of the start. */
export function variesStart(model: Model, { x, y }: Plane): boolean {
  return [x.name, ...(y ? [y.name] : [])].some((name) => isStart(model, name));
}

/** Values of parameters, and of coordinates of the start. */
export function apart(model: Model, values: Values): { parameters: Values; start: Values } {
  const of = (start: boolean): Values => Object.fromEntries(Object.entries(values).filter(([name]) => isStart(model, name) === start));
  return { parameters: of(false), start: of(true) };
}

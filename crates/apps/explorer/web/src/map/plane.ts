/** The window of the map: which parameters, which part of them; pan and zoom within sane bounds. */

import type { Axis, Model, Parameter, Plane } from "../protocol";
import type { Box, View } from "../plot";

/** The rectangle of data that the plane shows; a strip shows 0 to 1 upwards. */
export function viewOf({ x, y }: Plane): View {
  return { x0: x.low, x1: x.high, y0: y?.low ?? 0, y1: y?.high ?? 1 };
}

/** Zooms about a point given as fractions of the window, from the lower left. */
export function zoomed({ x, y }: Plane, factor: number, fx: number, fy: number): Plane {
  const about = (axis: Axis, f: number): Axis => {
    const span = axis.high - axis.low;
    const size = Math.max(span / factor, 1e-9 * Math.max(1e-3, Math.abs(axis.low), Math.abs(axis.high)));
    const centre = axis.low + f * span;
    return { ...axis, low: centre - f * size, high: centre + (1 - f) * size };
  };
  return { x: about(x, fx), y: y && about(y, fy) };
}

/** Moves what is shown by a distance in pixels. */
export function panned({ x, y }: Plane, box: Box, dx: number, dy: number): Plane {
  const by = (axis: Axis, fraction: number): Axis => {
    const shift = fraction * (axis.high - axis.low);
    return { ...axis, low: axis.low + shift, high: axis.high + shift };
  };
  return { x: by(x, -dx / box.width), y: y && by(y, dy / box.height) };
}

/** The plane moved, and cut where it is too large, into what the model allows. */
export function confined(plane: Plane, model: Model): Plane {
  const into = (axis: Axis): Axis => {
    const bounds = model.parameters.find((one) => one.name === axis.name)?.allowed;
    if (!bounds) return axis;
    const size = Math.min(axis.high - axis.low, bounds[1] - bounds[0]);
    const low = Math.min(bounds[1] - size, Math.max(bounds[0], axis.low));
    return axis.low >= bounds[0] && axis.high <= bounds[1] ? axis : { ...axis, low, high: low + size };
  };
  return { x: into(plane.x), y: plane.y && into(plane.y) };
}

/** The whole slider range of a parameter as an axis. */
export function fullAxis({ name, range }: Parameter): Axis {
  return { name, low: range[0], high: range[1] };
}

/** Whether two planes have the same parameters along their axes. */
export function sameAxes(a: Plane, b: Plane): boolean {
  return a.x.name === b.x.name && a.y?.name === b.y?.name;
}

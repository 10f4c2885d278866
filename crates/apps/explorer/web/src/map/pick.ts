/** From a pixel of the map to values of the parameters, with the digits that a pixel resolves. */

import { decimalsOf, roundStep } from "../numbers";
import { dataX, dataY, type Box, type View } from "../plot";
import type { Parameter, Values } from "../protocol";

/** The parameters along the axes; a strip has no `y`. */
export interface Sides {
  x: Parameter;
  y: Parameter | null;
}

/** The values under a pixel; `null` outside the frame. */
export function under(px: number, py: number, box: Box, view: View, { x, y }: Sides): Values | null {
  if (px < box.left || px > box.left + box.width || py < box.top || py > box.top + box.height) return null;
  const values: Values = { [x.name]: rounded(dataX(box, view, px), (view.x1 - view.x0) / box.width, x) };
  if (y) values[y.name] = rounded(dataY(box, view, py), (view.y1 - view.y0) / box.height, y);
  return values;
}

/** A value with the digits that `resolution` deserves, within what the parameter allows. */
export function rounded(value: number, resolution: number, { allowed: [low, high], whole }: Parameter): number {
  const decimals = whole ? 0 : decimalsOf(roundStep(resolution));
  return Math.min(high, Math.max(low, Number(value.toFixed(decimals))));
}

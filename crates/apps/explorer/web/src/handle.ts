/** `window.motiform`: a small read-only handle for tests and for curious readers at the console. */

import type { Frame } from "./binary";
import type { BodyPanel } from "./body/panel";
import type { BranchPanel } from "./branches/panel";
import type { MapPanel } from "./map/panel";
import type { View } from "./plot";

interface Handle {
  /** Frames received so far. */
  readonly frames: number;
  /** Number of the present motion: it grows with every change. */
  readonly revision: number;
  /** Where the body is; `null` until all that surrounds it stands. */
  position(): [number, number] | null;
  /** Coordinates of the shape. */
  state(): number[] | null;
  /** What stands beside the body: its time, place and outline, pairs relative to the place. */
  beside(): { t: number; position: [number, number]; radius: number; outline: number[] } | null;
  map: {
    /** The window in sight. */
    window(): View | null;
    /** CSS pixels on the canvas of a point of the plane. */
    toPixel(x: number, y: number): [number, number];
    readonly complete: boolean;
  };
  body: {
    /** CSS pixels on the canvas of a point of the plane. */
    toPixel(x: number, y: number): [number, number];
    /** Pixels of a model length at the size in which the body is drawn. */
    readonly scale: number;
    /** The unit of lengths beside the bar; `null`: that of the model. */
    readonly unit: string | null;
  };
  branches: {
    /** CSS pixels in the diagram of a point of a branch. */
    toPixel(branch: number, point: number): [number, number] | null;
  };
}

declare global {
  interface Window {
    motiform: Handle;
  }
}

export function expose(source: { frames(): number; revision(): number; frame(): Frame | null; beside(): Frame | null; map: MapPanel; branches: BranchPanel; body: BodyPanel }): void {
  const { map, branches, body } = source;
  window.motiform = Object.freeze({
    get frames() {
      return source.frames();
    },
    get revision() {
      return source.revision();
    },
    position() {
      const frame = source.frame();
      return frame && ([frame.x, frame.y] as [number, number]);
    },
    state() {
      const frame = source.frame();
      return frame && [...frame.state];
    },
    beside() {
      const frame = source.beside();
      return frame && { t: frame.t, position: [frame.x, frame.y] as [number, number], radius: frame.radius, outline: [...frame.outline] };
    },
    map: Object.freeze({
      window: () => map.window(),
      toPixel: (x: number, y: number) => map.toPixel(x, y),
      get complete() {
        return map.complete;
      },
    }),
    body: Object.freeze({
      toPixel: (x: number, y: number): [number, number] => [body.camera.toX(x), body.camera.toY(y)],
      get scale() {
        return body.scale;
      },
      get unit() {
        return body.camera.unit;
      },
    }),
    branches: Object.freeze({ toPixel: (branch: number, point: number) => branches.toPixel(branch, point) }),
  });
}

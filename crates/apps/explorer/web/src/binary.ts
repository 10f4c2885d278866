/** The binary messages of the server: frames of the motion, cells of the map, files. All little endian. */

const FRAME = 1;
const CELLS = 2;
const FILE = 3;
const SWARM = 4;
const HEADER = 16;

/** A moment of the motion, as views into the message: nothing is copied. */
export interface Frame {
  kind: "frame";
  revision: number;
  /** Whether `outline` is a closed curve without crossings. */
  outlined: boolean;
  /** Whether computing took too long: the body is behind its time. */
  behind: boolean;
  t: number;
  x: number;
  y: number;
  radius: number;
  state: Float64Array;
  /** Rows of `columns` numbers: t, x, y, speed, turning rate, observables. */
  rows: Float64Array;
  columns: number;
  /** Pairs relative to (x, y). */
  outline: Float64Array;
}

/** Cells of the map, sixteen bytes each; see `Lattice.take`. */
export interface Cells {
  kind: "cells";
  epoch: number;
  count: number;
  view: DataView;
}

/** The bodies of a swarm, as views into the message. */
export interface SwarmFrame {
  kind: "swarm";
  revision: number;
  t: number;
  count: number;
  /** Points of each outline. */
  points: number;
  /** x, y and distance of each body. */
  numbers: Float64Array;
  /** Pairs relative to the places, one outline after the other. */
  outlines: Float32Array;
}

/** A file to keep. */
export interface File {
  kind: "file";
  id: number;
  name: string;
  blob: Blob;
}

/** Reads a binary message; `null` where its kind is unknown or it is cut short. */
export function decode(buffer: ArrayBuffer): Frame | Cells | SwarmFrame | File | null {
  if (buffer.byteLength < 8) return null;
  const view = new DataView(buffer);
  switch (view.getUint8(0)) {
    case FRAME:
      return frame(buffer, view);
    case CELLS:
      return { kind: "cells", epoch: view.getUint32(4, true), count: view.getUint16(2, true), view: new DataView(buffer, HEADER) };
    case SWARM:
      return swarm(buffer, view);
    case FILE:
      return file(buffer, view);
    default:
      return null;
  }
}

function frame(buffer: ArrayBuffer, view: DataView): Frame | null {
  const flags = view.getUint8(1);
  const columns = view.getUint16(4, true);
  const sizes = [4, view.getUint32(12, true), view.getUint16(2, true) * columns, 2 * view.getUint16(6, true)];
  if (buffer.byteLength < HEADER + 8 * sizes.reduce((a, b) => a + b)) return null;
  let offset = HEADER;
  const [head, state, rows, outline] = sizes.map((size) => {
    const part = new Float64Array(buffer, offset, size);
    offset += 8 * size;
    return part;
  });
  const revision = view.getUint32(8, true);
  const [t, x, y, radius] = head;
  return { kind: "frame", revision, outlined: (flags & 1) !== 0, behind: (flags & 2) !== 0, t, x, y, radius, state, rows, columns, outline };
}

function swarm(buffer: ArrayBuffer, view: DataView): SwarmFrame | null {
  const [count, points] = [view.getUint16(2, true), view.getUint16(4, true)];
  const first = HEADER + 8;
  if (buffer.byteLength < first + count * (24 + 8 * points)) return null;
  const numbers = new Float64Array(buffer, first, 3 * count);
  const outlines = new Float32Array(buffer, first + 24 * count, 2 * points * count);
  return { kind: "swarm", revision: view.getUint32(8, true), t: view.getFloat64(HEADER, true), count, points, numbers, outlines };
}

function file(buffer: ArrayBuffer, view: DataView): File | null {
  const length = view.getUint32(4, true);
  if (buffer.byteLength < 8 + length) return null;
  const about: { id: number; name: string; mime: string } = JSON.parse(
    new TextDecoder().decode(new Uint8Array(buffer, 8, length)),
  );
  return { kind: "file", id: about.id, name: about.name, blob: new Blob([buffer.slice(8 + length)], { type: about.mime }) };
}

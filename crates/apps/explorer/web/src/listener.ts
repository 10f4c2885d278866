/** What a page receives, from a server through a WebSocket or from the workers of the page itself. */

import { decode, type Cells, type File, type Frame, type SwarmFrame } from "./binary";
import type { Answer, Wish } from "./protocol";

export interface Listener {
  answer(answer: Answer): void;
  frame(frame: Frame): void;
  cells(cells: Cells): void;
  file(file: File): void;
  swarm(frame: SwarmFrame): void;
  /** The connection opened, or closed with this code, and a sentence says why where something went wrong. */
  open(open: boolean, code: number, reason?: string): void;
  /** The server stopped answering, or answers again. */
  silent?(silent: boolean): void;
}

/** Where wishes go. */
export interface Transport {
  /** Bytes of the longest message that it carries. */
  readonly longest: number;
  /** Says it where somebody hears; a wish made meanwhile is dropped, `begin` follows the next greeting. */
  send(wish: Wish): void;
  /** Ends it for good. */
  end(): void;
}

/** How a page finds whom to speak with. */
export type Connect = (listener: Listener) => Transport;

/** Gives a message, text or bytes, to whom it is for. */
export function hear(data: string | ArrayBuffer, listener: Listener): void {
  if (typeof data === "string") {
    listener.answer(JSON.parse(data) as Answer);
    return;
  }
  const message = decode(data);
  if (message?.kind === "frame") listener.frame(message);
  else if (message?.kind === "cells") listener.cells(message);
  else if (message?.kind === "swarm") listener.swarm(message);
  else if (message?.kind === "file") listener.file(message);
}

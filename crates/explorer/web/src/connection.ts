/** The live connection: one WebSocket, tried again once a second after it closed. */

import { decode, type Cells, type File, type Frame } from "./binary";
import type { Answer, Wish } from "./protocol";

export interface Listener {
  answer(answer: Answer): void;
  frame(frame: Frame): void;
  cells(cells: Cells): void;
  file(file: File): void;
  /** The connection opened (`true`) or closed. */
  open(open: boolean): void;
}

const RETRY = 1000;

export class Connection {
  private socket: WebSocket | null = null;

  constructor(private readonly listener: Listener) {
    this.connect();
  }

  get open(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** Says it where the connection is open; a wish made while it is closed is dropped, `begin` follows the next greeting. */
  send(wish: Wish): void {
    if (this.open) this.socket?.send(JSON.stringify(wish));
  }

  private connect(): void {
    const address = new URL("live", document.baseURI);
    address.protocol = address.protocol.replace("http", "ws");
    address.hash = "";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.listener.open(true);
    socket.onmessage = (event) => this.hear(event.data);
    socket.onclose = () => {
      this.listener.open(false);
      window.setTimeout(() => this.connect(), RETRY);
    };
    this.socket = socket;
  }

  private hear(data: string | ArrayBuffer): void {
    if (typeof data === "string") {
      this.listener.answer(JSON.parse(data) as Answer);
      return;
    }
    const message = decode(data);
    if (message?.kind === "frame") this.listener.frame(message);
    else if (message?.kind === "cells") this.listener.cells(message);
    else if (message?.kind === "file") this.listener.file(message);
  }
}

/** The live connection: one WebSocket, tried again once a second after it closed. */

import { hear, type Listener, type Transport } from "./listener";
import { LONGEST, type Wish } from "./protocol";
import { Watchdog } from "./watchdog";

const RETRY = 1000;
/** The server refuses a page beyond its number: it is asked less often. */
export const FULL = 1013;
/** Closed for a fault: of the page, of a message that is too long, or of the server (RFC 6455, 7.4.1). */
const FAULTS = [1008, 1009, 1011];
const RETRY_FULL = 3000;

export class Connection implements Transport {
  readonly longest = LONGEST;
  private socket: WebSocket | null = null;
  private readonly watchdog = new Watchdog((silent) => this.listener.silent?.(silent));
  private over = false;

  constructor(private readonly listener: Listener) {
    this.connect();
  }

  get open(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  send(wish: Wish): void {
    if (!this.open) return;
    this.socket?.send(JSON.stringify(wish));
    this.watchdog.asked(wish);
  }

  end(): void {
    this.over = true;
    this.watchdog.rest();
    this.socket?.close();
  }

  private connect(): void {
    const address = new URL("live", document.baseURI);
    address.protocol = address.protocol.replace("http", "ws");
    address.hash = "";
    // A sandboxed frame has no origin: the server lets it in where its reader asked for a page in a frame.
    address.search = window.origin === "null" ? "embed" : "";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.listener.open(true, 0);
    socket.onmessage = (event) => {
      this.watchdog.heard();
      hear(event.data, this.listener);
    };
    socket.onclose = ({ code, reason }) => {
      this.watchdog.rest();
      if (this.over) return;
      this.listener.open(false, code, FAULTS.includes(code) && reason ? `The server closed the connection: ${reason}` : "");
      window.setTimeout(() => this.connect(), code === FULL ? RETRY_FULL : RETRY);
    };
    this.socket = socket;
  }
}

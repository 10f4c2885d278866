/** The live connection: one WebSocket, tried again once a second after it closed. */

import { hear, type Listener, type Transport } from "./listener";
import type { Wish } from "./protocol";

const RETRY = 1000;
/** The server refuses a page beyond its number: it is asked less often. */
export const FULL = 1013;
const RETRY_FULL = 3000;

export class Connection implements Transport {
  private socket: WebSocket | null = null;
  private over = false;

  constructor(private readonly listener: Listener) {
    this.connect();
  }

  get open(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  send(wish: Wish): void {
    if (this.open) this.socket?.send(JSON.stringify(wish));
  }

  end(): void {
    this.over = true;
    this.socket?.close();
  }

  private connect(): void {
    const address = new URL("live", document.baseURI);
    address.protocol = address.protocol.replace("http", "ws");
    address.hash = "";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.listener.open(true, 0);
    socket.onmessage = (event) => hear(event.data, this.listener);
    socket.onclose = ({ code }) => {
      if (this.over) return;
      this.listener.open(false, code);
      window.setTimeout(() => this.connect(), code === FULL ? RETRY_FULL : RETRY);
    };
    this.socket = socket;
  }
}

/** Whether the server is there, and what to do where it is not. */

import { copy } from "./clipboard";
import { FULL } from "./connection";
import { byId, setText } from "./dom";

/** The banner waits a little: a first connection takes a moment. */
const PATIENCE = 600;

let timer = 0;
let met = false;

/** Shows the connection; `code` says why it closed. A server that has no place for this page opens the connection and closes it at once. */
export function showConnection(open: boolean, code: number): void {
  if (open) return;
  const full = code === FULL;
  byId("connection").dataset.state = "closed";
  setText(byId("connection-text"), full ? "no free place" : met ? "no server" : "connecting");
  byId("banner-stopped").hidden = full;
  byId("banner-full").hidden = !full;
  window.clearTimeout(timer);
  timer = window.setTimeout(() => (byId("banner").hidden = false), full ? 0 : PATIENCE);
}

/** Somebody has said hello: a server, or the page's own workers, which do without one. */
export function showConnected(server: boolean): void {
  met = true;
  window.clearTimeout(timer);
  byId("connection").dataset.state = "open";
  setText(byId("connection-text"), server ? "connected" : "no server: this page computes");
  byId("banner").hidden = true;
}

byId("banner-copy").addEventListener("click", (event) => void copy(byId("banner-command").textContent ?? "", event.currentTarget as HTMLButtonElement));

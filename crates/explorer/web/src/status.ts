/** Whether the server is there, and what to do where it is not. */

import { copy } from "./clipboard";
import { byId, setText } from "./dom";

/** The banner waits a little: a first connection takes a moment. */
const PATIENCE = 600;

let timer = 0;
let met = false;

export function showConnection(open: boolean): void {
  const place = byId("connection");
  place.dataset.state = open ? "open" : "closed";
  setText(byId("connection-text"), open ? "connected" : met ? "no server" : "connecting");
  met ||= open;
  window.clearTimeout(timer);
  if (open) byId("banner").hidden = true;
  else timer = window.setTimeout(() => (byId("banner").hidden = false), PATIENCE);
}

byId("banner-copy").addEventListener("click", (event) => void copy(byId("banner-command").textContent ?? "", event.currentTarget as HTMLButtonElement));

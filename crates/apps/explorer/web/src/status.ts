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
  window.clearTimeout(timer);
  timer = window.setTimeout(() => show(full ? "full" : "stopped", false), full ? 0 : PATIENCE);
}

/** Shows that the server is there and does not answer, or that it answers again. */
export function showSilence(silent: boolean): void {
  byId("connection").dataset.state = silent ? "silent" : "open";
  setText(byId("connection-text"), silent ? "no answer" : "connected");
  show("silent", !silent);
}

/** The banner with one of its sentences. */
function show(sentence: "stopped" | "full" | "silent", hidden: boolean): void {
  for (const one of ["stopped", "full", "silent"]) byId(`banner-${one}`).hidden = one !== sentence;
  byId("banner-again").hidden = sentence === "silent";
  byId("banner").hidden = hidden;
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

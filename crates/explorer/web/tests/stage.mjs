/** One server and one browser for the tests of a file, and pages that forgive no error. */

import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { after, before } from "node:test";
import { chromium } from "playwright-core";
import { Server } from "./server.mjs";
import { Wire } from "./wire.mjs";

/** A busy machine may be slow; a page that hangs is found all the same. MOTIFORM_PATIENCE, in milliseconds, for who writes tests. */
export const PATIENCE = Number(process.env.MOTIFORM_PATIENCE ?? 60_000);

/** The body of figure 5(a) beside a map that costs next to nothing, for tests of something else. */
export const LIGHT = "preset=fig5a&x=kappa2:1.2:1.6&y=kappa3:0.7:1";

const NAMES = ["chromium", "chromium-browser", "google-chrome"];
/** How Chromium runs on a machine without a screen, without asking anybody anything. */
export const FLAGS = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** Chromium with a new, empty profile. */
export async function launch(more = []) {
  return chromium.launch({ executablePath: executable(), headless: true, args: [...FLAGS, ...more] });
}

/** The Chromium to use. */
export function executable() {
  const given = process.env.CHROMIUM;
  if (given) return given;
  const folders = (process.env.PATH ?? "").split(delimiter);
  const found = folders.flatMap((folder) => NAMES.map((name) => join(folder, name))).find((path) => existsSync(path));
  assert.ok(found, "no Chromium: install it (Debian: apt-get install chromium), or name one in CHROMIUM");
  return found;
}

/** A server (with these options) and a browser that live as long as the tests of this file. */
export function stage(options = {}) {
  const it = {};
  before(async () => Object.assign(it, { server: await Server.start(options), browser: await launch() }));
  after(async () => {
    await it.browser?.close();
    await it.server?.stop();
  });
  return it;
}

/**
 * A test upon a page of its own: `act` gets `page`, its `wire`, and the stage. Any error in the console, any exception and any
 * request that leaves the origin fails it; `hash` is what follows the # of the address, `tolerate` a pattern of errors to expect.
 */
export function upon(it, options, act) {
  return async () => {
    const guest = await visit(it, options);
    await act({ ...guest, ...it });
    await guest.leave();
  };
}

/** Opens a page; `leave` closes it and asserts that it behaved. */
export async function visit({ browser, server }, { hash = "", tolerate = null, address = server.address, ...context } = {}) {
  const place = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...context });
  const page = await place.newPage();
  page.setDefaultTimeout(PATIENCE);
  const [wire, faults] = [new Wire(page), []];
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(error.stack ?? String(error)));
  const own = [new URL(address).origin, new URL(address).origin.replace("http", "ws"), "data:", `blob:${new URL(address).origin}`];
  page.on("request", (request) => own.some((start) => request.url().startsWith(start)) || faults.push(`request to ${request.url()}`));
  page.on("websocket", (socket) => own.some((start) => socket.url().startsWith(start)) || faults.push(`socket to ${socket.url()}`));
  await page.goto(hash ? `${address.replace(/#.*/, "")}#${hash}` : address);
  const leave = async () => {
    await place.close();
    assert.deepEqual(faults.filter((text) => !tolerate?.test(text)), []);
  };
  return { page, wire, leave };
}

let folder = null;

/** Keeps a picture for people to look at, in MOTIFORM_SHOTS or in a temporary folder. */
export async function shoot(page, name) {
  folder ??= process.env.MOTIFORM_SHOTS ?? mkdtempSync(join(tmpdir(), "motiform-shots-"));
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`), animations: "allow" });
}

/** One server and one browser for the tests of a file, and pages that forgive no error. */

import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { after, before } from "node:test";
import { chromium, firefox } from "playwright-core";
import { Server } from "./server.mjs";
import { Wire } from "./wire.mjs";

/** A busy machine may be slow; a page that hangs is found all the same. MOTIFORM_PATIENCE, in milliseconds, for who writes tests. */
export const PATIENCE = Number(process.env.MOTIFORM_PATIENCE ?? 60_000);

/** The body of figure 5(a) beside a map that costs next to nothing, for tests of something else. */
export const LIGHT = "preset=fig5a&x=kappa2:1.2:1.6&y=kappa3:0.7:1";

/** The browser of this run: `BROWSER=firefox` for the other one. */
const FIREFOX = process.env.BROWSER === "firefox";

const NAMES = FIREFOX ? ["firefox-esr", "firefox"] : ["chromium", "chromium-browser", "google-chrome"];

/** Why a test is not for this run's browser: what it asks for, Firefox does not offer to those who drive it. */
export const onlyIn = (browser, what) => ({ skip: FIREFOX === (browser === "firefox") ? false : `${what}: only in ${browser}` });

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

/** The browser with a new, empty profile. */
export async function launch(more = []) {
  if (FIREFOX) return firefox.launch({ executablePath: executable(), headless: true, channel: "moz-firefox" });
  return chromium.launch({ executablePath: executable(), headless: true, args: [...FLAGS, ...more] });
}

/** The program of the browser. */
export function executable() {
  const given = process.env[FIREFOX ? "FIREFOX" : "CHROMIUM"];
  if (given) return given;
  const folders = (process.env.PATH ?? "").split(delimiter);
  const found = folders.flatMap((folder) => NAMES.map((name) => join(folder, name))).find((path) => existsSync(path));
  assert.ok(found, `no ${NAMES[0]}: install it (Debian: apt-get install ${NAMES[0]}), or name one in ${FIREFOX ? "FIREFOX" : "CHROMIUM"}`);
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

/** What the pages of tests show, where these do not say. */
export const VIEWPORT = { width: 1280, height: 720 };

/**
 * A test upon a page: `act` gets `page`, its `wire`, and the stage. Any error in the console, any exception and any
 * request that leaves the origin fails it; `hash` is what follows the # of the address, `tolerate` a pattern of errors to expect.
 */
export function upon(it, options, act) {
  return async () => {
    const guest = await visit(it, options);
    await act({ ...guest, ...it });
    await guest.leave();
  };
}

/** What stays with a tab when the page in it is another one. */
const LASTING = ["addInitScript", "emulateMedia", "exposeFunction", "route", "routeWebSocket"];

/**
 * Loads a page; `leave` leaves it and asserts that it behaved. A new tab takes twice as long as a page, so the next visit has the tab of
 * this one, with nothing stored and the pointer in a corner. A visit that does anything `LASTING`, or wants another context, has a tab of its `own`.
 */
export async function visit(it, { hash = "", tolerate = null, address = it.server.address, viewport = VIEWPORT, own = false, ...context } = {}) {
  const shared = !FIREFOX && !own && Object.keys(context).length === 0;
  const page = (shared && it.tab) || (await newTab(it.browser, { viewport, ...context }));
  if (page === it.tab) it.tab = null;
  await page.setViewportSize(viewport);
  const [wire, faults] = [new Wire(page), []];
  if (FIREFOX) await wire.listenInside(page);
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(error.stack ?? String(error)));
  const origins = [new URL(address).origin, new URL(address).origin.replace("http", "ws"), "data:", `blob:${new URL(address).origin}`];
  page.on("request", (request) => origins.some((start) => request.url().startsWith(start)) || faults.push(`request to ${request.url()}`));
  page.on("websocket", (socket) => origins.some((start) => socket.url().startsWith(start)) || faults.push(`socket to ${socket.url()}`));
  await page.goto(hash ? `${address.replace(/#.*/, "")}#${hash}` : address);
  if (shared) for (const name of LASTING) page[name] = () => assert.fail(`${name} stays with the tab: visit with { own: true }`);
  if (shared) assert.equal(await page.evaluate(() => localStorage.length + sessionStorage.length), 0);
  const leave = async () => {
    if (shared && !it.tab) it.tab = await vacate(page);
    else await page.context().close();
    assert.deepEqual(faults.filter((text) => !tolerate?.test(text) && !ofDriver(text)), []);
  };
  return { page, wire, leave };
}

/** A tab with nothing in it, which shares nothing with others. */
export async function newTab(browser, context) {
  const place = await browser.newContext(context);
  await place.addInitScript(unhurried);
  const page = await place.newPage();
  page.setDefaultTimeout(PATIENCE);
  return page;
}

/** The tab as it was before its visit. */
export async function vacate(page) {
  await page.mouse.move(0, 0);
  await page.evaluate(() => [localStorage, sessionStorage].forEach((one) => one.clear()));
  await page.goto("about:blank");
  for (const event of ["console", "pageerror", "request", "websocket"]) page.removeAllListeners(event);
  return page;
}

/**
 * The file that a click saves: its name and where it lies. Firefox tells nobody of a download that the page itself starts, so there
 * the link is read that the page would follow.
 */
export async function saved(page, button) {
  const folder = mkdtempSync(join(tmpdir(), "motiform-saved-"));
  const path = join(folder, "file");
  if (!FIREFOX) {
    const [download] = await Promise.all([page.waitForEvent("download"), button.click()]);
    await download.saveAs(path);
    return { name: download.suggestedFilename(), path };
  }
  await page.evaluate(catchLink);
  await button.click();
  const { name, base64 } = await page.evaluate(() => window.saved);
  writeFileSync(path, Buffer.from(base64, "base64"));
  return { name, path };
}

/** In the page: the next link that a script follows is not followed; the file behind it is read. */
function catchLink() {
  const { click } = HTMLAnchorElement.prototype;
  const make = URL.createObjectURL;
  let file = null;
  URL.createObjectURL = (blob) => make.call(URL, (file = blob));
  window.saved = new Promise((resolve) => {
    HTMLAnchorElement.prototype.click = function () {
      HTMLAnchorElement.prototype.click = click;
      URL.createObjectURL = make;
      const name = this.download;
      const reader = new FileReader();
      reader.addEventListener("load", () => resolve({ name, base64: reader.result.split(",")[1] }));
      reader.readAsDataURL(file);
    };
  });
}

/** A double click at a place on the screen. Those who drive Firefox have to say themselves that two clicks are one. */
export async function doubleClick(page, x, y) {
  if (!FIREFOX) return page.mouse.dblclick(x, y);
  await page.mouse.click(x, y);
  await page.mouse.click(x, y);
  await page.evaluate(([u, v]) => document.elementFromPoint(u, v).dispatchEvent(new MouseEvent("dblclick", { bubbles: true, clientX: u, clientY: v })), [x, y]);
}

/** To take a picture in Firefox, Playwright adds a style to the page, which the page does not allow. */
const DRIVERS = /Content-Security-Policy.*inline style \(style-src-elem\)/;

/** Whether an error in the console is of who drives the browser, not of the page. It comes some time after the picture, or not at all if the page closes first. */
export const ofDriver = (text) => FIREFOX && DRIVERS.test(text);

/**
 * In the page, before it begins: between two pictures lie three more. Without a graphics card drawing is most of what a test costs, and what
 * is tested holds at any pace: time goes on as the clock does.
 */
export function unhurried() {
  const next = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (act) => window.setTimeout(() => next(act), 50);
}

/** In the page, before it begins: storage is denied, as browsers do in frames of other sites and where cookies are blocked. */
export function denied() {
  for (const name of ["localStorage", "sessionStorage"]) {
    Object.defineProperty(window, name, {
      get() {
        throw new DOMException(`Failed to read the '${name}' property from 'Window': Access is denied for this document.`, "SecurityError");
      },
    });
  }
}

/** Keeps a picture for people to look at, in the folder that MOTIFORM_SHOTS names; where it names none, nobody looks. */
export async function shoot(page, name) {
  const folder = process.env.MOTIFORM_SHOTS;
  if (!folder) return;
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`), animations: "allow" });
}

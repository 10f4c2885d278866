/** Conditions to wait for. Nothing here measures time: each returns once what it names is so. */

import assert from "node:assert/strict";
import { PATIENCE } from "./stage.mjs";

/** What the server computes for long, names and whole maps, gets so many times more patience. */
const COMPUTING = 4;

/** Waits until `holds()` here, in the test, is true. */
export async function until(holds, what) {
  const end = performance.now() + PATIENCE;
  while (!(await holds())) {
    assert.ok(performance.now() < end, `waited in vain: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}

/** Waits until the body of this preset, or any, has been seen; gives that frame. */
export async function seen(page, wire, preset = null) {
  await until(() => {
    const begun = wire.last.get("begun");
    return begun && (preset === null || begun.preset === preset) && wire.frame?.revision >= begun.revision;
  }, `a body of ${preset ?? "any preset"}`);
  await page.waitForFunction(() => window.motiform.position() !== null);
  return wire.frame;
}

/** Waits until the body is paused and everything under way has come; gives the frame it stands at. */
export async function stands(page, wire) {
  await page.locator("#play[aria-pressed=false]").waitFor();
  let frame = null;
  await until(async () => {
    frame = wire.frame;
    await pictures(page, 10);
    return frame && frame === wire.frame && frame.revision === present(wire);
  }, "the body to stand still");
  return frame;
}

/** The number of the present motion. */
function present(wire) {
  const [begun, changed] = [wire.last.get("begun"), wire.last.get("changed")];
  return Math.max(begun?.revision ?? 0, changed?.revision ?? 0);
}

/** Waits for the answer to a change made after `revision`; gives the first frame of the changed motion. */
export async function changed(wire, revision) {
  await until(() => wire.frame.revision > revision, "a frame after the change");
  return wire.frames.find((frame) => frame.revision > revision);
}

/** Waits until the body is later, and elsewhere, than now. */
export async function moves(page, wire) {
  const before = await seen(page, wire);
  const place = await page.evaluate(() => window.motiform.position());
  await until(() => wire.frame.t > before.t, "time to go on");
  await page.waitForFunction((old) => {
    const now = window.motiform.position();
    return now !== null && (now[0] !== old[0] || now[1] !== old[1]);
  }, place);
}

/** Waits until the motion has a name, or this one; gives the name. */
export async function named(page, name = null) {
  await page.waitForFunction((wanted) => {
    const regime = document.getElementById("regime").dataset.regime;
    return wanted ? regime === wanted : regime !== "";
  }, name, { timeout: COMPUTING * PATIENCE });
  return page.locator("#regime").getAttribute("data-regime");
}

/** Waits until all cells of the map are there. */
export async function mapped(page) {
  await page.waitForFunction(() => window.motiform.map.complete, null, { timeout: COMPUTING * PATIENCE });
}

/** Lets the page draw so many pictures: the least that it needs to do whatever it is about to do. */
export async function pictures(page, count) {
  await page.evaluate((left) => new Promise((done) => {
    const next = () => (left-- > 0 ? requestAnimationFrame(next) : done());
    next();
  }), count);
}

/** Waits until the sight of the body stands: the same in five pictures. */
export async function rests(page) {
  const sight = () => page.evaluate(() => [window.motiform.body.scale, ...window.motiform.body.toPixel(0, 0)].join());
  await until(async () => {
    const before = await sight();
    await pictures(page, 5);
    return before === (await sight());
  }, "the sight to stand");
}

/** The slider of a parameter. */
export function slider(page, name) {
  return page.locator(`[data-parameter="${name}"] input[type=range]`);
}

/** The field for the number of a parameter. */
export function number(page, name) {
  return page.locator(`[data-parameter="${name}"] input.number`);
}

/** Puts a slider to a value as a drag would: the value, then its event. */
export async function slide(locator, value) {
  await locator.evaluate((input, to) => {
    input.value = String(to);
    input.dispatchEvent(new Event("input", { bubbles: true }));
  }, value);
}

/** Where a point of the map's plane is on the screen. */
export async function pixel(page, x, y) {
  await page.locator("#map").scrollIntoViewIfNeeded();
  return page.evaluate(([a, b]) => {
    const box = document.getElementById("map").getBoundingClientRect();
    const [px, py] = window.motiform.map.toPixel(a, b);
    return [box.left + px, box.top + py];
  }, [x, y]);
}

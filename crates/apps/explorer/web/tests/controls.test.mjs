/** What one does to the body, by mouse and by keys. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { doubleClick, LIGHT, stage, upon } from "./stage.mjs";
import { changed, moves, pictures, slide, stands, until } from "./waits.mjs";

const it = stage();
const output = (page, name) => page.locator(`#${name}-value`).textContent();

/** Nothing is asked of the server while the page draws many pictures. */
async function assertStill(page, wire) {
  const frame = await stands(page, wire);
  const clock = await page.locator("#clock-t").textContent();
  const asked = wire.count("advance");
  await pictures(page, 15);
  assert.deepEqual([wire.count("advance"), wire.frame.t], [asked, frame.t]);
  assert.equal(await page.locator("#clock-t").textContent(), clock);
  return frame;
}

test("play and pause", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#play").click();
  await assertStill(page, wire);
  assert.equal(await page.locator("#play").getAttribute("aria-label"), "Play");
  await page.locator("#play").click();
  await moves(page, wire);
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press(" ");
  await assertStill(page, wire);
  await page.keyboard.press(" ");
  await moves(page, wire);
}));

test("a paused page comes to rest: it draws nothing", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#play").click();
  await stands(page, wire);
  await page.evaluate(() => {
    const { prototype } = CanvasRenderingContext2D;
    const { stroke } = prototype;
    window.strokes = 0;
    prototype.stroke = function (...path) {
      if (this.canvas.id === "body") window.strokes++;
      return stroke.apply(this, path);
    };
  });
  const strokes = () => page.evaluate(() => window.strokes);
  await until(async () => {
    const before = await strokes();
    await pictures(page, 10);
    return (await strokes()) === before;
  }, "the camera to come to rest");
}));

const waysOfRestart = { "the button": (page) => page.locator("#restart").click(), "the key r": (page) => page.keyboard.press("r") };
const waysOfKick = { "the button": (page) => page.locator("#kick").click(), "the key k": (page) => page.keyboard.press("k") };

test("restart and kick", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  for (const way of Object.values(waysOfRestart)) {
    await until(() => wire.frame?.t > 2, "more time to pass than one stretch of motion can take");
    const { revision, t } = wire.frame;
    await page.evaluate(() => document.activeElement.blur());
    await way(page);
    assert.ok((await changed(wire, revision)).t < t);
  }
  await moves(page, wire);
  await page.locator("#play").click();
  for (const way of Object.values(waysOfKick)) {
    const before = await stands(page, wire);
    await page.evaluate(() => document.activeElement.blur());
    await way(page);
    const after = await changed(wire, before.revision);
    assert.deepEqual([after.t, after.x, after.y], [before.t, before.x, before.y]);
    assert.notDeepEqual(after.state, before.state);
  }
  const { revision } = wire.frame;
  await page.keyboard.press("r");
  assert.equal((await changed(wire, revision)).t, 0);
}));

test("noise", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await slide(page.locator("#noise"), 80);
  await until(() => wire.last.get("changed")?.noise > 0, "noise");
  assert.equal(wire.last.get("changed").noise, 0.01);
  assert.match(await output(page, "noise"), /0\.01/);
  await moves(page, wire);
  await page.locator("#noise").focus();
  await page.keyboard.press("Home");
  await until(() => wire.last.get("changed").noise === 0, "no noise");
  assert.equal(await output(page, "noise"), "0");
}));

test("speed", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  const [low, high] = wire.last.get("begun").speeds;
  const LONGEST = 0.1; // seconds of the wall that a stretch of motion stands for at most
  await page.locator("#speed").focus();
  for (const [key, speed] of [["Home", low], ["End", high], ["Home", low]]) {
    await page.keyboard.press(key);
    const asked = wire.count("advance");
    await until(() => wire.count("advance") > asked + 2, "more motion");
    const { dt } = wire.said.get("advance");
    assert.ok(dt > 0 && dt <= 1.001 * LONGEST * speed, `${key}: ${dt} asked for at speed ${speed}`);
  }
  const slow = await output(page, "speed");
  await slide(page.locator("#speed"), 700);
  assert.notEqual(await output(page, "speed"), slow);
  await moves(page, wire);
}));

test("follow ends with a drag, and comes back by key", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  const following = (yes) => page.locator(`#follow[aria-pressed=${yes}]`).waitFor();
  const box = await page.locator("#body").boundingBox();
  const [x, y] = [box.x + 0.1 * box.width, box.y + 0.8 * box.height]; // beside the body
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y + 30, { steps: 5 });
  await page.mouse.up();
  await following(false);
  await page.keyboard.press("f");
  await following(true);
  await page.keyboard.press("f");
  await following(false);
  await page.mouse.wheel(0, -300);
  await moves(page, wire);
}));

test("a double click on the body follows again", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#follow").click();
  await page.locator("#follow[aria-pressed=false]").waitFor();
  const { x, y, width, height } = await page.locator("#body").boundingBox();
  await doubleClick(page, x + width / 2, y + height / 2);
  await pictures(page, 10);
  assert.equal(await page.locator("#follow").getAttribute("aria-pressed"), "true");
}));

test("a hidden page costs nothing", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  const hide = (hidden) => page.evaluate((value) => {
    Object.defineProperty(document, "hidden", { configurable: true, get: () => value });
    Object.defineProperty(document, "visibilityState", { configurable: true, get: () => (value ? "hidden" : "visible") });
    document.dispatchEvent(new Event("visibilitychange"));
  }, hidden);
  await hide(true);
  await pictures(page, 3);
  const asked = wire.count("advance");
  await pictures(page, 20);
  assert.equal(wire.count("advance"), asked);
  await hide(false);
  await until(() => wire.count("advance") > asked, "the motion to go on");
  await moves(page, wire);
}));

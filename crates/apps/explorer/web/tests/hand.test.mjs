/** The body in the hand: pulled, carried, thrown; and everything undone and done again. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { LIGHT, onlyIn, shoot, stage, upon } from "./stage.mjs";
import { changed, mapped, moves, number, pictures, rests, seen, slide, slider, stands, until } from "./waits.mjs";

const it = stage();
const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

/** Where the centre of the body is on the screen, and pixels of a model length as the body is drawn. */
async function centre(page, { x, y }) {
  return page.evaluate(([u, v]) => {
    const box = document.getElementById("body").getBoundingClientRect();
    const [px, py] = window.motiform.body.toPixel(u, v);
    return [box.left + px, box.top + py, window.motiform.body.scale];
  }, [x, y]);
}

/** How far the outline reaches from the position in this direction (a unit vector), in model lengths. */
function reach({ outline }, [c, s]) {
  const turned = outline.map(([x, y]) => [c * x + s * y, c * y - s * x]);
  const crossings = turned.map(([x, y], i) => {
    const [u, v] = turned[(i + 1) % turned.length];
    return y * v <= 0 && y !== v ? x + ((u - x) * y) / (y - v) : -Infinity;
  });
  return Math.max(...crossings);
}

/** The direction of the outline's farthest point. In others a bent body may have its position outside, and nothing to be caught. */
function farthest({ outline }) {
  const [x, y] = outline.reduce((best, point) => (Math.hypot(...point) > Math.hypot(...best) ? point : best));
  return [x / Math.hypot(x, y), y / Math.hypot(x, y)];
}

/** A paused page, and the frame it stands at. */
async function paused(page, wire) {
  await moves(page, wire);
  await page.locator("#play").click();
  const frame = await stands(page, wire);
  await rests(page);
  return frame;
}

for (const preset of ["fig5a", "fig6a"]) {
  test(`${preset}: the outline is pulled, and the position stays`, upon(it, { hash: preset === "fig5a" ? LIGHT : "preset=fig6a&x=length:6:7&y=none" }, async ({ page, wire }) => {
    const before = await paused(page, wire);
    const [x, y, scale] = await centre(page, before);
    const [c, s] = farthest(before);
    const from = reach(before, [c, s]);
    const toward = (length, options) => page.mouse.move(x + c * length * scale, y - s * length * scale, options);
    await toward(from);
    await page.waitForFunction(() => document.getElementById("body").dataset.under === "pull");
    await page.mouse.down();
    const to = from + 0.25 * before.radius;
    await toward(to, { steps: 6 });
    await page.mouse.up();
    await until(() => wire.frame.revision > before.revision && Math.abs(reach(wire.frame, [c, s]) - to) < 0.1 * before.radius, "the outline to follow");
    assert.deepEqual([wire.frame.t, wire.frame.x, wire.frame.y], [before.t, before.x, before.y]);
    await shoot(page, `pulled-${preset}`);
  }));
}

test("the inside is carried to another place, and thrown where the hand lets go while it moves", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  const before = await paused(page, wire);
  const [x, y, scale] = await centre(page, before);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 60, y + 40, { steps: 6 });
  await page.waitForTimeout(150); // the hand rests
  await page.mouse.up();
  await until(() => Math.abs(wire.frame.x - (before.x - 60 / scale)) < 1e-6 * Math.abs(scale) + 0.05, "the body to be carried");
  assert.ok(Math.abs(wire.frame.y - (before.y - 40 / scale)) < 0.05);
  assert.deepEqual([...wire.frame.state], [...before.state], "velocity and shape stay");
  // On a busy machine a hand may rest between two events: then it has let go at rest, and throws again.
  for (let tries = 0; tries < 8 && !wire.said.get("put")?.velocity; tries++) {
    const carried = await stands(page, wire);
    await rests(page);
    const [u, v] = await centre(page, carried);
    await page.mouse.move(u, v);
    await page.mouse.down();
    for (let k = 1; k <= 8; k++) await page.mouse.move(u - 12 * k, v);
    await page.mouse.up();
    await pictures(page, 20);
  }
  await until(() => wire.said.get("put")?.velocity, "the body to be thrown");
  await until(() => wire.frame.state[0] === wire.said.get("put").velocity[0], "its velocity");
  assert.ok(wire.frame.state[0] < 0 && Math.abs(wire.frame.state[1]) < 0.3 * Math.abs(wire.frame.state[0]));
  assert.deepEqual([...wire.frame.state].slice(2), [...before.state].slice(2), "the shape stays");
}));

test("with a finger, too, and the page does not scroll", onlyIn("chromium", "touches"), upon(it, { hash: LIGHT, ...PHONE }, async ({ page, wire }) => {
  const before = await paused(page, wire);
  await page.evaluate(() => window.scrollTo(0, 0));
  await pictures(page, 5);
  const [x, y, scale] = await centre(page, before);
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  await touch("touchStart", [{ x, y }]);
  for (let k = 1; k <= 8; k++) await touch("touchMove", [{ x, y: y + 5 * k }]);
  await page.waitForTimeout(150);
  await touch("touchEnd", []);
  await until(() => Math.abs(wire.frame.y - (before.y - 40 / scale)) < 0.1, "the body to be carried");
  assert.equal(await page.evaluate(() => window.scrollY), 0);
  assert.equal(await page.locator("#follow").getAttribute("aria-pressed"), "true");
}));

test("by keys the body is put elsewhere, thrown, and its outline pulled", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  const before = await paused(page, wire);
  const press = async (key) => {
    const { revision } = await stands(page, wire);
    await page.locator("#body").focus();
    await page.keyboard.press(key);
    return changed(wire, revision);
  };
  const put = await press("ArrowRight");
  assert.ok(put.x > before.x && put.y === before.y && put.t === before.t);
  assert.deepEqual(put.state, before.state);
  const thrown = await press("Shift+ArrowUp");
  assert.ok(thrown.state[0] === 0 && thrown.state[1] > 0, `${thrown.state}`);
  assert.deepEqual([thrown.x, thrown.y, ...thrown.state.slice(2)], [put.x, put.y, ...put.state.slice(2)]);
  const pulled = await press("o");
  assert.deepEqual(pulled.state.slice(0, 2), thrown.state.slice(0, 2), "the velocity stays");
  assert.notDeepEqual(pulled.state, thrown.state);
  await page.keyboard.press("Control+z");
  await until(() => wire.frame.state.every((value, k) => value === thrown.state[k]), "the shape before the pull");
}));

test("kicks have a strength", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await paused(page, wire);
  const sizes = [];
  for (const position of [0, 1000]) {
    await slide(page.locator("#strength"), position);
    const before = await stands(page, wire);
    await page.locator("#kick").click();
    const after = await changed(wire, before.revision);
    sizes.push(Math.hypot(...after.state.map((value, k) => value - before.state[k])));
    assert.ok(Math.abs(wire.said.get("kick").strength - [0.01, 2][position / 1000]) < 1e-3);
  }
  assert.ok(sizes[1] > 20 * sizes[0], `${sizes}`);
}));

test("everything is undone, and done again", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  const first = await paused(page, wire);
  assert.equal(await page.locator("#undo").isDisabled(), true);
  /** Undoes by key, and waits for this. */
  const back = async (holds, what) => {
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press("Control+z");
    await until(holds, what);
  };
  await page.locator("#kick").click();
  const kicked = await changed(wire, first.revision);
  await stands(page, wire);
  await slide(slider(page, "kappa2"), 0.8);
  await until(() => wire.last.get("changed").parameters.kappa2 === 0.8, "the parameter");
  await stands(page, wire);
  await slide(page.locator("#noise"), 80);
  await until(() => wire.last.get("changed").noise === 0.01, "the noise");
  await stands(page, wire);
  await page.locator("#x-axis").selectOption("gamma");
  await until(() => wire.last.get("map").x.name === "gamma", "the axis");
  await mapped(page);
  await back(() => wire.last.get("map").x.name === "kappa2", "the axis of before");
  await back(() => wire.last.get("changed").noise === 0, "no noise");
  await back(() => wire.last.get("changed").parameters.kappa2 === 0.9, "the parameter of before");
  await until(() => wire.frame.state.every((value, k) => value === kicked.state[k]), "the state after the kick");
  await back(() => wire.frame.state.every((value, k) => value === first.state[k]), "the state before the kick");
  assert.deepEqual([wire.frame.t, wire.frame.x, wire.frame.y], [first.t, first.x, first.y]);
  assert.equal(await number(page, "kappa2").inputValue(), "0.9");
  assert.equal(await page.locator("#undo").isDisabled(), true);
  await page.keyboard.press("Control+Shift+z");
  await until(() => wire.frame.state.every((value, k) => value === kicked.state[k]), "the kick again");
  await page.locator("#redo").click();
  await until(() => wire.last.get("changed").parameters.kappa2 === 0.8, "the parameter again");
}));

test("another preset is undone, too", upon(it, { hash: `${LIGHT}&kappa2=0.8` }, async ({ page, wire }) => {
  const before = await paused(page, wire);
  await page.getByTestId("preset-fig2").click();
  await seen(page, wire, "fig2");
  await page.locator("#undo").click();
  await until(() => wire.last.get("begun").preset === "fig5a", "the preset of before");
  await until(() => wire.frame.t === before.t, "its frame");
  assert.deepEqual([...wire.frame.state], [...before.state]);
  assert.equal(wire.last.get("begun").parameters.kappa2, 0.8);
}));

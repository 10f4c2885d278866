/** The map: a click takes the body there, wheel, drag and keys move the window, the line below tells what is known. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { doubleClick, saved, stage, upon } from "./stage.mjs";
import { changed, mapped, moves, named, number, pictures, pixel, seen, stands, until } from "./waits.mjs";

/** Points of the plane of figure 4, well inside their regions. */
const STRAIGHT = [1.2, 0.6];
const CIRCULAR = [1.5, 0.12];

/** A window about both that is soon complete: its cells are simple motions. */
const WINDOW = "x=kappa2:1:1.6&y=kappa3:0.1:0.7";

const it = stage();
const view = (page) => page.evaluate(() => window.motiform.map.window());

async function click(page, point) {
  await page.mouse.click(...(await pixel(page, ...point)));
}

for (const preset of ["fig4", "fig5a"]) {
  test(`a click in the map of ${preset} takes the body there, and its motion follows`, upon(it, { hash: `preset=${preset}&${WINDOW}` }, async ({ page, wire }) => {
    await moves(page, wire);
    for (const [point, regime] of [[STRAIGHT, "straight"], [CIRCULAR, "circular"], [STRAIGHT, "straight"]]) {
      const before = wire.frame;
      await click(page, point);
      const after = await changed(wire, before.revision);
      for (const [name, value] of [["kappa2", point[0]], ["kappa3", point[1]]]) {
        const shown = Number(await number(page, name).inputValue());
        assert.ok(Math.abs(shown - value) < 0.02, `${name} is ${shown}, clicked at ${value}`);
        assert.equal(await page.locator(`[data-parameter="${name}"] input[type=range]`).evaluate((one) => Math.abs(one.valueAsNumber - one.parentElement.querySelector("input.number").value) < 0.02), true);
        assert.ok(Math.abs(wire.last.get("changed").parameters[name] - shown) < 1e-9);
      }
      assertNoJump(wire, after);
      assert.equal(await named(page, regime), regime);
      await moves(page, wire);
    }
  }));
}

/** Between the last frame before a change and the first one after it the body goes no further than its speed takes it. */
function assertNoJump(wire, after) {
  const before = wire.frames[wire.frames.indexOf(after) - 1];
  const [dt, way] = [after.t - before.t, Math.hypot(after.x - before.x, after.y - before.y)];
  const speed = Math.hypot(before.state[0], before.state[1]); // of the tensor model: v1, v2 come first
  assert.ok(dt >= 0 && way <= 3 * speed * dt + 1e-9, `a jump of ${way} in ${dt}`);
}

test("basins: a map of starts, whose click lets the body begin there", upon(it, { hash: "preset=fig4&kappa2=0.12&kappa3=0.45&x=v1:-1.5:1.5&y=u222:-1.5:1.5&play=0" }, async ({ page, wire }) => {
  await mapped(page);
  const names = await page.locator("#map-legend li").allTextContents();
  for (const name of ["circular", "chaotic"]) assert.ok(names.some((text) => text.includes(name)), `${names}`);
  const before = wire.frame;
  await click(page, [0.8, -1]);
  const after = await changed(wire, before.revision);
  const begun = wire.said.get("start").coordinates;
  assert.deepEqual([after.t, after.x, after.y], [0, 0, 0]);
  assert.deepEqual([after.state[0], after.state[5]], [begun.v1, begun.u222]);
  const cells = wire.last.get("map"); // the body begins at the centre of the cell
  assert.ok(Math.abs(begun.v1 - 0.8) < 0.51 * cells.x.step && Math.abs(begun.u222 + 1) < 0.51 * cells.y.step, JSON.stringify(begun));
  const [x, y] = await pixel(page, begun.v1, begun.u222);
  await page.mouse.move(x + 1, y);
  await until(() => wire.last.get("evidence")?.regime, "the verdict of the cell");
  assert.equal(await named(page), wire.last.get("evidence").regime, "the body does what its start is coloured by");
  await page.locator("#y-axis").selectOption("kappa2");
  await until(() => wire.last.get("map").y.name === "kappa2" && wire.last.get("map").x.name === "v1", "a parameter on the other axis");
}));

test("a click keeps the state of a paused body to the bit", upon(it, { hash: `preset=fig5a&${WINDOW}` }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#play").click();
  const before = await stands(page, wire);
  await click(page, STRAIGHT);
  const after = await changed(wire, before.revision);
  assert.deepEqual([after.t, after.x, after.y, after.state], [before.t, before.x, before.y, before.state]);
}));

test("the wheel zooms about the pointer, a drag pans, a double click resets", upon(it, { hash: "preset=fig4" }, async ({ page, wire }) => {
  await seen(page, wire);
  const home = await view(page);
  const [x, y] = await pixel(page, ...STRAIGHT);
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, -200);
  await page.waitForFunction((old) => window.motiform.map.window().x1 - window.motiform.map.window().x0 < 0.9 * (old.x1 - old.x0), home);
  const [zx, zy] = await pixel(page, ...STRAIGHT);
  assert.ok(Math.hypot(zx - x, zy - y) < 1.5, "the point under the pointer stays");
  const { revision } = wire.frame;
  await page.mouse.down();
  await page.mouse.move(x + 30, y + 20, { steps: 4 });
  await page.mouse.up();
  const [px, py] = await pixel(page, ...STRAIGHT);
  assert.ok(Math.hypot(px - x - 30, py - y - 20) < 6.5, `dragged by 30, 20, moved by ${px - x}, ${py - y}`);
  await until(() => wire.last.get("map")?.epoch === wire.said.get("map").epoch, "the map of the new window");
  assert.equal(wire.frame.revision, revision, "zoom and drag leave the body alone");
  const parameters = wire.last.get("begun").parameters;
  await doubleClick(page, ...(await pixel(page, ...STRAIGHT)));
  await page.waitForFunction((old) => JSON.stringify(window.motiform.map.window()) === JSON.stringify(old), home);
  await until(() => !wire.last.has("changed") || wire.last.get("changed").parameters.kappa2 === parameters.kappa2, "the clicks of a double click to be undone");
}));

test("the keyboard walks, zooms and resets", upon(it, { hash: "preset=fig4" }, async ({ page, wire }) => {
  await seen(page, wire);
  await until(() => wire.last.has("map"), "the cells to walk by");
  const home = await view(page);
  const value = () => page.evaluate(() => ["kappa2", "kappa3"].map((name) => Number(document.querySelector(`[data-parameter="${name}"] input.number`).value)));
  await page.locator("#map").focus();
  let before = await value();
  for (const [key, axis, sign] of [["ArrowRight", 0, 1], ["ArrowUp", 1, 1], ["Shift+ArrowLeft", 0, -1], ["ArrowDown", 1, -1]]) {
    const { revision } = wire.frame;
    await page.keyboard.press(key);
    await changed(wire, revision);
    const after = await value();
    assert.ok(sign * (after[axis] - before[axis]) > 0 && after[1 - axis] === before[1 - axis], `${key}: ${before} to ${after}`);
    before = after;
  }
  const width = async () => ((one) => one.x1 - one.x0)(await view(page));
  await page.keyboard.press("+");
  assert.ok((await width()) < home.x1 - home.x0);
  await page.keyboard.press("-");
  assert.ok(Math.abs((await width()) / (home.x1 - home.x0) - 1) < 1e-9);
  await page.keyboard.press("+");
  await page.keyboard.press("0");
  assert.deepEqual(await view(page), home);
}));

test("pointing at the map tells regime and evidence", upon(it, { hash: `preset=fig5a&${WINDOW}` }, async ({ page, wire }) => {
  await seen(page, wire);
  await mapped(page);
  const readout = page.locator("#readout");
  const idle = await readout.textContent();
  for (const [point, regime] of [[STRAIGHT, "straight"], [CIRCULAR, "circular"]]) {
    await page.mouse.move(...(await pixel(page, ...point)));
    await readout.getByText(regime, { exact: true }).waitFor();
    await page.waitForFunction(() => document.querySelector(".readout-why").textContent.length > 20);
    assert.match(await readout.textContent(), /κ.*=.*κ.*=/);
  }
  await page.mouse.move(5, 5);
  await pictures(page, 2);
  assert.equal(await readout.textContent(), idle);
}));

test("other axes, and none", upon(it, { hash: `preset=fig5a&${WINDOW}` }, async ({ page, wire }) => {
  await seen(page, wire);
  await page.locator("#x-axis").selectOption("gamma");
  await until(() => wire.last.get("map")?.x.name === "gamma", "a map over gamma");
  await page.locator("#y-axis").selectOption("");
  await until(() => wire.last.get("map")?.y === null, "a map of one axis");
  await page.locator("#map-reset").click();
  await until(() => wire.last.get("map")?.x.name === "kappa2", "the map of the preset again");
}));

test("along one axis the exponents stand above the strip", upon(it, { hash: "preset=fig5b&x=kappa2:0.45:0.6&y=none" }, async ({ page, wire }) => {
  await seen(page, wire);
  await mapped(page);
  await page.locator("#map-legend li").filter({ hasText: "Lyapunov" }).waitFor();
  // Chaos all along: dots of its colour well above the strip.
  const dots = await page.evaluate(() => {
    const canvas = document.getElementById("map");
    const { data } = canvas.getContext("2d").getImageData(70, 20, canvas.width - 90, 0.6 * canvas.height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) count += data[k] > 100 && data[k] > 1.6 * data[k + 1] && data[k + 1] > 1.5 * data[k + 2] ? 1 : 0;
    return count;
  });
  assert.ok(dots > 100, `${dots} pixels`);
  await page.locator('details.save[data-figure="map"] > summary').click();
  const { name } = await saved(page, page.locator('[data-save="map-exponents.svg"]'));
  assert.equal(name, "motiform-fig5b-map-exponents.svg");
}));

test("the window stays within what the model allows", upon(it, { hash: "preset=fig6b" }, async ({ page, wire }) => {
  await seen(page, wire);
  const [low] = wire.last.get("hello").registry.models.find((one) => one.name === "cell").parameters.find((one) => one.name === "length").allowed;
  const { x, y, width, height } = await page.locator("#map").boundingBox();
  await page.mouse.move(x + 0.2 * width, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 0.95 * width, y + height / 2, { steps: 4 });
  await page.mouse.up();
  const { x0, x1 } = await view(page);
  assert.ok(x0 >= low && x1 > x0 + 20, `${x0} to ${x1}`);
}));

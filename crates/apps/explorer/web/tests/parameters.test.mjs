/** Sliders and numbers: the motion follows, what is not allowed is refused where one sees it. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { LIGHT, stage, upon } from "./stage.mjs";
import { changed, moves, named, number, slide, slider } from "./waits.mjs";

const it = stage();
const refusal = (page, name) => page.locator(`[data-parameter="${name}"] .refusal`);

test("a slider changes the regime", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  assert.equal(await named(page), "zigzag");
  const { revision } = wire.frame;
  await slide(slider(page, "kappa2"), 0.5);
  await changed(wire, revision);
  assert.ok(Math.abs(Number(await number(page, "kappa2").inputValue()) - 0.5) < 0.02);
  assert.equal(wire.last.get("changed").parameters.kappa3, 0.1);
  assert.equal(await named(page, "chaotic"), "chaotic");
  await page.locator(`[aria-label="Reset kappa2"]`).click();
  assert.equal(await named(page, "zigzag"), "zigzag");
  assert.equal(wire.last.get("changed").parameters.kappa2, 0.9);
}));

test("a slider follows the mouse and the arrow keys", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  const one = slider(page, "kappa3");
  const start = Number(await number(page, "kappa3").inputValue());
  const { revision } = wire.frame;
  await one.focus();
  await page.keyboard.press("ArrowRight");
  await changed(wire, revision);
  const stepped = Number(await number(page, "kappa3").inputValue());
  assert.ok(stepped > start && stepped - start < 0.1, `${start} to ${stepped}`);
  const box = await one.boundingBox();
  await page.mouse.move(box.x + 0.3 * box.width, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.9 * box.width, box.y + box.height / 2, { steps: 12 });
  await page.mouse.up();
  await page.waitForFunction((from) => document.querySelector(`[data-parameter="kappa3"] input.number`).value > from, stepped + 0.1);
  await moves(page, wire);
}));

test("a number that is not allowed is refused at its row, and the old value stays", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  const field = number(page, "kappa2");
  for (const bad of ["1e7", "-1e9"]) {
    await field.fill(bad);
    await field.press("Enter");
    await refusal(page, "kappa2").filter({ hasText: /kappa2|10000000/ }).waitFor();
    await field.blur();
    assert.equal(await field.inputValue(), "0.9");
    assert.ok(Math.abs(Number(await slider(page, "kappa2").inputValue()) - 0.9) < 0.02);
  }
  const { revision } = wire.frame;
  await field.fill("0.7");
  await field.press("Enter");
  await changed(wire, revision);
  assert.equal(wire.last.get("changed").parameters.kappa2, 0.7);
  await refusal(page, "kappa2").waitFor({ state: "hidden" });
  await field.fill("");
  await field.blur();
  assert.equal(await field.inputValue(), "0.7");
  await moves(page, wire);
}));

test("the sliders of the figure\u2019s plane go over its window, the others over their range", upon(it, { hash: "preset=fig1" }, async ({ page, wire }) => {
  await moves(page, wire);
  const span = async (name) => slider(page, name).evaluate((one) => [one.min, one.max, one.step].map(Number));
  await slider(page, "b1").waitFor();
  assert.deepEqual(await span("kappa2"), [-0.22, 0.22, 0.001]);
  const { range } = wire.last.get("hello").registry.models[0].parameters.find((one) => one.name === "b1");
  assert.deepEqual((await span("b1")).slice(0, 2), range);
}));

test("what the reader changed is told beside the preset\u2019s sentence, until it is as before", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  const told = page.locator("#departed");
  assert.ok(!(await told.isVisible()));
  const { revision } = wire.frame;
  await slide(slider(page, "kappa3"), 0.5);
  await changed(wire, revision);
  await told.filter({ hasText: "changed: \u03ba3" }).waitFor();
  await page.locator(`[aria-label="Reset kappa3"]`).click();
  await told.waitFor({ state: "hidden" });
}));

test("equations are set in the paper\u2019s symbols", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator(".equations summary").click();
  const text = await page.locator(".equation").first().textContent();
  assert.match(text, /^\(V\)dvi\/dt = \u03b3 vi \u2212 v2 vi \u2212 a1 Sij vj/);
  assert.doesNotMatch(await page.locator(".equation-list").textContent(), /kappa|gamma|theta|delta/);
}));

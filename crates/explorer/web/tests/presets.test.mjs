/** Every figure of the paper, one click each: it begins, moves and gets a name. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { shoot, stage, upon } from "./stage.mjs";
import { moves, named, seen } from "./waits.mjs";

/** Names that are certain; the others change with time, or take long to tell apart. */
const NAMES = { fig2: "rectangular", fig3: "quasi-periodic", fig4: "circular", fig5a: "zigzag", fig5b: "chaotic", fig6a: "chaotic", fig6b: "quasi-periodic", fig6c: "zigzag", fig6d: "zigzag" };

const it = stage();

/** Moves a map of one axis to where its cells cost nothing: its cores are wanted for the name. */
async function leaveTheMapAlone(page) {
  const { x, y, width, height } = await page.locator("#map").boundingBox();
  await page.mouse.move(x + 0.1 * width, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 0.95 * width, y + height / 2, { steps: 4 });
  await page.mouse.up();
}

test("every preset begins, moves and is named", upon(it, { hash: "preset=fig2" }, async ({ page, wire }) => {
  await seen(page, wire);
  const presets = wire.last.get("hello").registry.presets.map((one) => one.name);
  assert.deepEqual(await page.locator("[data-preset]").allTextContents(), presets);
  assert.ok(presets.includes("fig1") && presets.includes("fig6d"), presets.join());
  for (const preset of presets) {
    await page.locator(`[data-preset="${preset}"]`).click();
    await seen(page, wire, preset);
    await moves(page, wire);
    assert.equal(await page.locator("[data-preset][aria-pressed=true]").textContent(), preset);
    if (preset.startsWith("fig6")) await leaveTheMapAlone(page);
    const regime = await named(page);
    assert.equal(regime, NAMES[preset] ?? regime, preset);
    await shoot(page, preset);
  }
}));

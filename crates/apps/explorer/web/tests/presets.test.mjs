/** Every figure of the paper, one click each: it begins, moves and gets a name. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { shoot, stage, upon } from "./stage.mjs";
import { moves, named, pixel, seen } from "./waits.mjs";

/** Names that are certain; the others change with time, or take long to tell apart. */
const NAMES = { fig2: "rectangular", fig3: "quasi-periodic", fig4: "circular", fig5a: "zigzag", fig5b: "chaotic", fig6a: "chaotic", fig6b: "quasi-periodic", fig6c: "zigzag", fig6d: "zigzag" };

const it = stage();

/** Zooms a map of one axis in to where its cells cost nothing: its cores are wanted for the name. */
async function leaveTheMapAlone(page) {
  await page.locator("#map").focus();
  const low = await page.evaluate(() => window.motiform.map.window().x0);
  await page.mouse.move(...(await pixel(page, low, 0.5)));
  for (let k = 0; k < 10; k++) await page.mouse.wheel(0, -200);
  await page.waitForFunction((from) => window.motiform.map.window().x1 < from + 3, low);
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

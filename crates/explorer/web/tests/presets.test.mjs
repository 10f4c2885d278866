/** Every figure of the paper, one click each: it begins, moves and gets a name. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { shoot, stage, upon } from "./stage.mjs";
import { moves, named, seen } from "./waits.mjs";

const PRESETS = {
  fig1: ["straight", "circular", "quasi-periodic", "rectangular", "motionless"],
  fig2: ["rectangular"],
  fig3: ["quasi-periodic"],
  fig4: ["zigzag", "straight", "circular", "chaotic", "quasi-periodic"],
  fig5a: ["zigzag"],
  fig5b: ["chaotic"],
};

const it = stage();

test("every preset begins, moves and is named", upon(it, {}, async ({ page, wire }) => {
  await seen(page, wire);
  const presets = wire.last.get("hello").registry.presets.map((one) => one.name);
  assert.deepEqual(await page.locator("[data-preset]").allTextContents(), presets);
  assert.ok(presets.includes("fig1") && presets.includes("fig6d"), presets.join());
  const regimes = wire.last.get("hello").registry.regimes.map((one) => one.name);
  for (const preset of presets) {
    const start = performance.now();
    await page.locator(`[data-preset="${preset}"]`).click();
    await seen(page, wire, preset);
    await moves(page, wire);
    const t1 = performance.now();
    const regime = await named(page);
    assert.ok((PRESETS[preset] ?? regimes).includes(regime), `${preset} is ${regime}`);
    assert.equal(await page.locator("[data-preset][aria-pressed=true]").textContent(), preset);
    await shoot(page, preset);
    console.log(preset, regime, t1 - start, performance.now() - start);
  }
}));

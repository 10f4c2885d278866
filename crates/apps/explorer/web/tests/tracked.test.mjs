/** A tracked cell beside the model that was fitted to it. */

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { assertAccessible } from "./axe.mjs";
import { binary } from "./server.mjs";
import { shoot, stage, upon } from "./stage.mjs";
import { moves, seen, stands, until } from "./waits.mjs";

const FRAMES = 60;
const MISSING = 30;
const INTERVAL = 2;
const RADIUS = 2;

/** How far the noise of the cell moves its centre, and the noise: of frame t and coordinate k, within 1. */
const SHAKE = 0.1;
const shake = (t, k) => Math.sin(12.9898 * t * t + 78.233 * k + 0.5 * k * k * t);

/** The cell: it goes along a shaken circle, long along its way, and its size breathes. */
function cell(t) {
  const angle = 0.05 * t;
  const z = [0.3 + 0.1 * Math.sin(0.4 * t), 0.1 * Math.cos(0.7 * t)];
  return {
    centre: [10 * Math.cos(angle) + SHAKE * shake(t, 1), 10 * Math.sin(angle) + SHAKE * shake(t, 2)],
    // z_n turns with minus n times the angle of the body
    z: z.map((size, k) => [size * Math.cos((k + 2) * (angle + Math.PI / 2)), -size * Math.sin((k + 2) * (angle + Math.PI / 2))]),
  };
}

function distance({ z }, angle) {
  return z.reduce((sum, [re, im], k) => sum + 2 * (re * Math.cos((k + 2) * angle) - im * Math.sin((k + 2) * angle)), RADIUS);
}

/** The folder of a fit to this cell, in um and seconds. */
function fitted() {
  const folder = mkdtempSync(join(tmpdir(), "motiform-"));
  let text = "cell,frame,i,x,y\n";
  for (let frame = 0; frame < FRAMES; frame++) {
    if (frame === MISSING) continue;
    const now = cell(INTERVAL * frame);
    for (let i = 0; i < 40; i++) {
      const angle = (2 * Math.PI * i) / 40;
      const r = distance(now, angle) * (1 + 1e-4 * Math.sin(37 * i + 11 * frame));
      text += `one,${frame},${i},${now.centre[0] + r * Math.cos(angle)},${now.centre[1] + r * Math.sin(angle)}\n`;
    }
  }
  writeFileSync(join(folder, "cells.csv"), text);
  const words = ["fit", "cells.csv", "--pixel-size", "1", "--interval", String(INTERVAL), "--out", "fits", "--draws", "2", "--simulations", "0", "--no-report"];
  const { status, stderr } = spawnSync(binary(), words, { cwd: folder, encoding: "utf8" });
  assert.ok(status === 0 || status === 1, stderr);
  const model = join(folder, "fits", "cell-one.toml");
  assert.ok(existsSync(model), "the search converged, and there is a model");
  return model;
}

const it = stage({ file: fitted() });
const beside = (page) => page.evaluate(() => window.motiform.beside());

test("the cell stands beside its model, at the time and the scale of the body", upon(it, { hash: "model=cell-one.toml" }, async ({ page, wire }) => {
  await seen(page, wire);
  assert.equal(wire.last.get("hello").tracked.frames.length, FRAMES - 1);
  assert.match(await page.locator("#twin-label").textContent(), /^tracked cell one.* of 118\.0 s/);
  await moves(page, wire);
  await page.locator("#play").click();
  const { t } = await stands(page, wire);
  await until(async () => Math.abs((await beside(page)).t - (t % (INTERVAL * (FRAMES - 1)))) < 1e-9, "the cell at the time of the body");
  const shown = await beside(page);
  const before = INTERVAL * Math.floor(shown.t / INTERVAL);
  const part = (shown.t - before) / INTERVAL;
  if (Math.abs(before / INTERVAL - MISSING) > 1) {
    const [now, next] = [cell(before), cell(before + INTERVAL)];
    for (const k of [0, 1]) {
      const wanted = now.centre[k] + part * (next.centre[k] - now.centre[k]);
      assert.ok(Math.abs(shown.position[k] - wanted) < 1e-3, `${shown.position} ${wanted}`);
    }
    const [x, y] = shown.outline;
    const wanted = distance(now, 0) + part * (distance(next, 0) - distance(now, 0));
    assert.ok(Math.abs(x - wanted) < 2e-3 && Math.abs(y) < 1e-12, `${x} ${wanted}`);
  }
  assert.ok(Math.abs(wire.frame.radius - shown.radius) < 0.01, "the body is drawn with the radius of the cell");
  assert.equal(await page.evaluate(() => window.motiform.body.unit), "\u00b5m", "the bar has the unit of the cell");
  const texts = await page.locator(".axis-name").allTextContents();
  assert.deepEqual(texts, ["frequency (1/s)", "averaging time (s); bands: 95 %"]);
  assert.match(await page.locator("#clock").textContent(), /^t = [\d.]+ s x = \S+ \u00b5m y = \S+ \u00b5m$/);
  assert.match(await page.locator("#trail-value").textContent(), / s$/);
  assert.match(await page.locator("#series").textContent(), /speed\u00b5m\/s.*turning raterad\/s.*t \(s\)/);
  await shoot(page, "tracked");
}));

test("it begins again when its record ends, and is not drawn where no frame is", upon(it, { hash: "model=cell-one.toml" }, async ({ page, wire }) => {
  await seen(page, wire);
  await page.locator("#play").click();
  await stands(page, wire);
  const at = async (t) => {
    await page.evaluate((time) => (location.hash = location.hash.replace(/([#&]t=)[^&]*/, `$1${time}`)), t);
    await until(async () => Math.abs((await beside(page))?.t - (t % (INTERVAL * (FRAMES - 1)))) < 1e-6, `the cell at ${t}`);
  };
  await at(INTERVAL * MISSING);
  assert.match(await page.locator("#twin-label").textContent(), /no frame here/);
  await at(INTERVAL * (FRAMES - 1) + 4);
  assert.match(await page.locator("#twin-label").textContent(), /one4\.0 of 118\.0 s$/);
}));

test("it can be hidden, gives way to a place that is held, and is no part of other models", upon(it, { hash: "model=cell-one.toml" }, async ({ page, wire }) => {
  await seen(page, wire);
  await page.locator("#compare").click();
  await page.getByRole("button", { name: "End the comparison" }).click();
  await page.getByRole("button", { name: "Hide the tracked cell" }).waitFor();
  await assertAccessible(page);
  await page.getByTestId("preset-fig5a").or(page.locator("#presets button").filter({ hasText: "fig5a" })).first().click();
  await seen(page, wire, "fig5a");
  await page.locator("#twin-part").waitFor({ state: "hidden" });
  await page.goBack();
  await page.getByRole("button", { name: "Hide the tracked cell" }).click();
  await page.locator("#twin-part").waitFor({ state: "hidden" });
}));

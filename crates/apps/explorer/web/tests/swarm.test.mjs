/** Many bodies at once, and two places side by side. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { LIGHT, shoot, stage, upon } from "./stage.mjs";
import { changed, moves, named, number, pictures, seen, until } from "./waits.mjs";

const it = stage();

/** Begins a swarm by its menu. */
async function begin(page, from, bodies = null) {
  await page.locator("#swarm-menu > summary").click();
  await page.locator("#swarm-from").selectOption(from);
  if (bodies !== null) await page.locator("#swarm-bodies").fill(String(bodies));
  await page.locator("#swarm-begin").click();
}

test("sixty bodies from random shapes are named by what they end in", upon(it, { hash: "preset=fig4&kappa2=1.11&kappa3=0.105&x=kappa2:1.2:1.6&y=kappa3:0.7:1" }, async ({ page, wire }) => {
  await moves(page, wire);
  await begin(page, "starts");
  await until(() => wire.swarms.length > 5 && wire.swarms.at(-1).length === 60, "sixty bodies");
  for (let k = 0; k < 4 && wire.members.size < 60; k++) await until(() => wire.members.size >= 15 * (k + 1), "names"); // long work has more patience
  await pictures(page, 20);
  const names = new Set(wire.members.values());
  assert.ok(names.size >= 2, [...names].join());
  const note = await page.locator("#swarm-note").innerText();
  for (const name of names) assert.match(note, new RegExp(`\\d+ ${name}`));
  assert.equal([...note.matchAll(/(\d+) /g)].reduce((sum, [, count]) => sum + Number(count), 0), 60);
  await shoot(page, "swarm");
  const { revision } = wire.frame;
  await page.locator("#kick").click();
  await changed(wire, revision);
  await until(() => wire.swarms.at(-1).revision > revision, "the swarm to go on");
  await page.locator("#swarm-menu > summary").click();
  await page.locator("#swarm-end").click();
  await page.locator("#swarm-note").waitFor({ state: "hidden" });
  const count = wire.swarms.length;
  await moves(page, wire);
  assert.ok(wire.swarms.length <= count + 2);
}));

test("a neighbour of a chaotic body parts from it", upon(it, { hash: "preset=fig5b&x=kappa2:1.2:1.6&y=kappa3:0.7:1&speed=40" }, async ({ page, wire }) => {
  await moves(page, wire);
  await begin(page, "near");
  await until(() => wire.swarms.length > 0, "the neighbour");
  const [first] = wire.swarms[0];
  await until(() => wire.swarms.at(-1)[0].distance > 100 * first.distance, "the two to part");
  await page.locator("#swarm-note").filter({ hasText: "times that of the beginning" }).waitFor();
  await shoot(page, "neighbour");
}));

test("another preset has no swarm", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await begin(page, "starts", 5);
  await page.locator("#swarm-note").waitFor();
  await page.getByTestId("preset-fig2").click();
  await seen(page, wire, "fig2");
  await page.locator("#swarm-note").waitFor({ state: "hidden" });
}));

test("the place that is held goes on beside the body", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#compare").click();
  await page.locator("#twin-label b").filter({ hasText: "zigzag" }).waitFor();
  const { revision } = wire.frame;
  await number(page, "kappa2").fill("0.5");
  await number(page, "kappa2").press("Enter");
  await until(() => wire.last.get("changed")?.parameters.kappa2 === 0.5, "the other place");
  await named(page);
  assert.ok(revision >= 0);
  assert.match(await page.locator("#twin-label").innerText(), /κ2 = 0\.9/);
  const ink = () => page.evaluate(() => {
    const canvas = document.getElementById("twin");
    return canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.reduce((sum, value) => sum + value, 0);
  });
  const before = await ink();
  await pictures(page, 30);
  assert.notEqual(await ink(), before, "it moves");
  const [left, right] = [await page.locator("#twin").boundingBox(), await page.locator("#body").boundingBox()];
  assert.ok(left.x + left.width <= right.x + 1);
  await shoot(page, "compare");
  await page.locator("#twin-end").click();
  await page.locator("#twin-part").waitFor({ state: "hidden" });
  await moves(page, wire);
}));

/** Branches: followed at a click, drawn in the diagram and upon the map; a click on a point takes the body there. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { shoot, stage, upon } from "./stage.mjs";
import { changed, moves, pictures, pixel, seen, slide, slider, until } from "./waits.mjs";

/** A zigzag that loses its symmetry at kappa2 = 1.148, and a map about it that costs little. */
const ZIGZAG = "preset=fig4&kappa2=1.12&kappa3=0.1&x=kappa2:1.1:1.16&y=kappa3:0.098:0.104";

const it = stage();

/** Follows, and waits until it is done. */
async function follow(page, wire) {
  await page.locator("#show-branches").click();
  await page.locator("#branch-follow").click();
  await until(() => wire.last.has("followed"), "the end of the branches");
  await page.locator("#branch-follow", { hasText: "Follow" }).waitFor();
}

/** Clicks on a point of a branch in the diagram; gives the first frame there. */
async function take(page, wire, branch, point) {
  const { revision } = wire.frame;
  const box = await page.locator("#branches").boundingBox();
  const [x, y] = await page.evaluate(([a, b]) => window.motiform.branches.toPixel(a, b), [branch, point]);
  await page.mouse.click(box.x + x, box.y + y);
  return changed(wire, revision);
}

test("a branch is followed, and the body leaves an unstable point of it", upon(it, { hash: ZIGZAG, viewport: { width: 1440, height: 900 } }, async ({ page, wire }) => {
  await moves(page, wire);
  await follow(page, wire);
  const zigzag = wire.branches[0];
  assert.deepEqual([...new Set(zigzag.between)], ["zigzag"]);
  for (const text of ["zigzag", "unstable", "symmetry breaking"]) await page.locator("#branch-legend li").filter({ hasText: text }).first().waitFor();
  const special = wire.last.get("specials").points.find((point) => point.kind === "symmetry-breaking");
  assert.ok(Math.abs(special.parameter - 1.148047) < 1e-5);

  // from the middle of the unstable part on to the end
  const last = zigzag.unstable.length - 1;
  const unstable = Math.round((special.point + last) / 2);
  assert.ok(zigzag.unstable[unstable] > 0);
  await take(page, wire, 0, unstable);
  assert.ok(Math.abs(wire.last.get("changed").parameters.kappa2 - zigzag.parameter[unstable]) < 1e-8);
  await page.locator("#orbit-note").getByText("unstable: the body leaves this orbit").waitFor();
  await pictures(page, 20);
  await shoot(page, "branches-unstable");

  await take(page, wire, 0, 2);
  await page.locator("#orbit-note").getByText("stable: the body stays on this orbit").waitFor();
  await page.locator("#branch-tip").getByText("zigzag, stable").waitFor();

  // the same points lie upon the map, at the value of the other parameter
  await page.locator("#show-map").click();
  const { revision } = wire.frame;
  await page.mouse.click(...(await pixel(page, zigzag.parameter[unstable], 0.1)));
  await changed(wire, revision);
  await until(() => wire.last.get("changed").parameters.kappa3 === 0.1, "a point of the branch, not one of the map");
  await page.locator("#map-branch-legend li").filter({ hasText: "symmetry breaking" }).waitFor();

  // a parameter off the axes: other branches
  const before = wire.frame.revision;
  await slide(slider(page, "gamma"), 0.99);
  await changed(wire, before);
  assert.equal(await page.locator("#orbit-note").isVisible(), false);
  await page.locator("#show-branches").click();
  await page.locator("#branch-empty").getByText("A branch is").waitFor();
}));

test("keys walk along a branch and take the body there", upon(it, { hash: ZIGZAG }, async ({ page, wire }) => {
  await moves(page, wire);
  await follow(page, wire);
  await page.locator("#branches").focus();
  await page.keyboard.press("PageDown");
  await page.locator("#branch-tip b").waitFor();
  await page.keyboard.press("Shift+ArrowLeft");
  await page.locator("#branch-tip").getByText("on branch 0").waitFor();
  const { revision } = wire.frame;
  await page.keyboard.press("Enter");
  await changed(wire, revision);
  await until(() => wire.last.has("orbit"), "the orbit");
}));

test("chaos has no branch, and this is said", upon(it, { hash: "preset=fig5b&x=kappa2:0.5:0.6&y=none" }, async ({ page, wire }) => {
  await seen(page, wire);
  await follow(page, wire);
  await page.locator("#branch-empty").getByText("neither is steady nor repeats").waitFor();
}));

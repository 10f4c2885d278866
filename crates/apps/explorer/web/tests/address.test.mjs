/** The address holds everything: a reload, or a copied link, gives the same page; a damaged one gives a page all the same. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { LIGHT, stage, upon, visit } from "./stage.mjs";
import { moves, named, seen, slide, slider, stands, until } from "./waits.mjs";

const it = stage();

/** Everything that a reader sees of the state of the page. */
async function look(page, wire) {
  const shown = await page.evaluate(() => ({
    window: window.motiform.map.window(),
    axes: ["x-axis", "y-axis"].map((id) => document.getElementById(id).value),
    speed: document.getElementById("speed-value").textContent,
    noise: document.getElementById("noise-value").textContent,
    section: ["section", "section-y"].map((id) => document.getElementById(id).value),
    playing: document.getElementById("play").getAttribute("aria-pressed"),
    preset: document.querySelector("[data-preset][aria-pressed=true]")?.textContent ?? null,
    parameters: [...document.querySelectorAll("[data-parameter]")].map((row) => [row.dataset.parameter, row.querySelector("input.number").value]),
  }));
  const { t, x, y, state } = await stands(page, wire);
  return { shown, body: [t, x, y, ...state] };
}

function assertSame(now, before) {
  const { window: a, ...rest } = now.shown;
  const { window: b, ...others } = before.shown;
  assert.deepEqual(rest, others);
  for (const side of Object.keys(b)) assert.ok(Math.abs(a[side] - b[side]) <= 1e-9, `window: ${side}`);
  assert.equal(now.body.length, before.body.length);
  now.body.forEach((value, k) => assert.ok(Math.abs(value - before.body[k]) <= 1e-9 * Math.max(1, Math.abs(value)), `t, x, y, state: ${now.body} was ${before.body}`));
}

/** A page that differs in everything from what its preset opens with, paused. */
async function arrange(page, wire) {
  await moves(page, wire);
  await slide(slider(page, "kappa2"), 0.75);
  await page.locator("#x-axis").selectOption("gamma");
  await page.locator("#map").focus();
  await page.keyboard.press("+");
  await slide(page.locator("#speed"), 500);
  await slide(page.locator("#noise"), 40);
  await page.locator("#section").selectOption("path");
  await page.locator("#section-y").fill("1.5");
  await page.locator("#section-y").press("Enter");
  await until(() => wire.last.get("changed")?.noise > 0, "noise");
  await moves(page, wire);
  await page.locator("#play").click();
  const all = await look(page, wire);
  assert.equal(all.shown.playing, "false");
  return all;
}

test("a reload restores everything", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  const before = await arrange(page, wire);
  await page.waitForFunction((t) => location.hash.includes("play=0") && location.hash.includes(`t=${t}&`) && location.hash.includes("section=path"), before.body[0]);
  wire.frames.length = 0;
  wire.last.clear();
  await page.reload();
  await seen(page, wire);
  assertSame(await look(page, wire), before);
  await page.locator("#play").click();
  await moves(page, wire);
  await named(page);
}));

test("a copied link opens the same in another page", async () => {
  const mine = await visit(it, { hash: LIGHT, permissions: ["clipboard-read", "clipboard-write"] });
  const before = await arrange(mine.page, mine.wire);
  await mine.page.locator("#share-menu > summary").click();
  await mine.page.locator("#share-link").click();
  await mine.page.locator("#share-link").getByText("Copied").waitFor();
  const link = await mine.page.evaluate(() => navigator.clipboard.readText());
  assert.ok(link.startsWith(`${it.server.address}#`), link);
  const theirs = await visit(it, { hash: link.split("#")[1] });
  await seen(theirs.page, theirs.wire);
  assertSame(await look(theirs.page, theirs.wire), before);
  await theirs.leave();
  await mine.leave();
});

test("another address in the same page is opened", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.evaluate(() => (location.hash = "#preset=fig2&play=1"));
  await seen(page, wire, "fig2");
  await moves(page, wire);
}));

/** Addresses, and what the page's note about them must name. */
const DAMAGED = {
  "preset=fig5a&kappa2=banana": "kappa2=banana",
  "preset=fig5a&x=kappa2:2:1&y=kappa3:0:1": "x=kappa2:2:1",
  "preset=fig99": "preset=fig99",
  "model=tenser&preset=fig5a": "model=tenser",
  "preset=fig5a&nonsense=1": "nonsense=1",
  "preset=fig5a&%E0%A4%A=%&gamma=%zz": "gamma=%zz",
  "preset=fig5a&kappa2=1e7": "kappa2=1e7",
  "preset=fig5a&noise=1e9": "noise=1e9",
  "preset=fig5a&t=5&at=1,2&state=1,2,3": "state",
  "preset=fig5a&t=5&at=1,2&state=1,x,3,4,5,6": "state=1,x,3,4,5,6",
};

test("what is damaged in an address is left aside with a note", upon(it, { hash: "&&&=&&?!" }, async ({ page, wire }) => {
  await moves(page, wire);
  for (const [hash, note] of Object.entries(DAMAGED)) {
    wire.last.clear();
    await page.evaluate((to) => (location.hash = to), hash);
    await page.locator("#toasts li").filter({ hasText: note }).first().waitFor();
    await moves(page, wire);
  }
}));

test("a damaged address at the start", upon(it, { hash: `${LIGHT}&kappa2=banana&speed=-1&play=2` }, async ({ page, wire }) => {
  for (const note of ["kappa2=banana", "speed=-1", "play=2"]) await page.locator("#toasts li").filter({ hasText: note }).waitFor();
  await moves(page, wire);
}));

test("a speed beyond the bounds of the slider is not used", upon(it, { hash: `${LIGHT}&speed=1e300` }, async ({ page, wire }) => {
  await moves(page, wire);
  await until(() => wire.count("advance") > 3, "motion");
  assert.ok(wire.said.get("advance").dt <= 0.1 * wire.last.get("begun").speeds[1], `asked for dt = ${wire.said.get("advance").dt}`);
}));

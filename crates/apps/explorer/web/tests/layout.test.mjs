/** Nothing leaves the screen, overlaps or jumps, from phone to desktop. Pictures for people are taken on the way. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { shoot, stage, upon, visit } from "./stage.mjs";
import { changed, moves, named, pictures, pixel, seen, slide, slider } from "./waits.mjs";

const SIZES = [[375, 812], [768, 1024], [1280, 720], [1440, 900], [1920, 1080]];
/** A page that stands still for the reader; 0.1 is called good on the web. */
const MOST_SHIFT = 0.02;

const it = stage();

/** Pairs of texts that touch each other though they should not. */
function overlaps(page) {
  return page.evaluate(() => {
    const texts = [...document.querySelectorAll("header > *, #about, .panel-head > *, #why, #clock, #readout, #map-legends, #map-progress, #branch-legend, #branch-hint, #branch-progress, #orbit-note, .controls > *, .axis-name, .parameter > *")];
    const boxes = texts.filter((one) => one.checkVisibility() && !one.classList.contains("sr")).map((one) => [one, one.getBoundingClientRect()]);
    const bad = [];
    for (const [a, p] of boxes) {
      for (const [b, q] of boxes) {
        if (a === b || a.contains(b) || b.contains(a) || !p.width || !q.width) continue;
        const [w, h] = [Math.min(p.right, q.right) - Math.max(p.left, q.left), Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top)];
        if (w > 1.5 && h > 1.5) bad.push(`${a.id || a.className} and ${b.id || b.className} by ${w.toFixed(0)} x ${h.toFixed(0)}`);
      }
    }
    return bad;
  });
}

for (const [width, height] of SIZES) {
  test(`${width} x ${height}: nothing is cut off or overlaps`, async () => {
    const { page, wire, leave } = await visit(it, { hash: "preset=fig3", viewport: { width, height }, colorScheme: "light" });
    await moves(page, wire);
    await named(page, "quasi-periodic"); // the longest name
    await page.locator("#map-legend li").nth(1).waitFor();
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme });
      await pictures(page, 8);
      const [inner, scroll] = await page.evaluate(() => [document.documentElement.clientWidth, document.documentElement.scrollWidth]);
      assert.ok(scroll <= inner, `${scroll} wide in ${inner}`);
      assert.deepEqual(await overlaps(page), []);
      await shoot(page, `${width}x${height}-${colorScheme}`);
    }
    await page.locator("#show-branches").click();
    await pictures(page, 4);
    assert.deepEqual(await overlaps(page), []);
    await shoot(page, `${width}x${height}-branches`);
    await leave();
  });
}

test("nothing jumps", upon(it, { hash: "", own: true }, async ({ page, wire }) => {
  await seen(page, wire);
  const shifts = () => page.evaluate(() => new Promise((done) => {
    const list = [];
    new PerformanceObserver((entries, observer) => {
      for (const one of entries.getEntries()) list.push(one);
      observer.disconnect();
    }).observe({ type: "layout-shift", buffered: true });
    requestAnimationFrame(() => setTimeout(() => done(list.map((one) => ({ value: one.value, at: one.startTime, of: one.sources.map(({ node, previousRect: a, currentRect: b }) => `${node?.id || node?.className || node?.nodeName} ${[a.x, a.y, a.width, a.height]} to ${[b.x, b.y, b.width, b.height]}`) })))));
  }));
  await named(page);
  for (const preset of ["fig3", "fig6a", "fig1", "fig5b"]) {
    await page.evaluate((name) => document.querySelector(`[data-preset="${name}"]`).click(), preset); // no input of the mouse: a jump after it counts
    await seen(page, wire, preset);
    await moves(page, wire);
  }
  await named(page);
  await page.mouse.move(...(await pixel(page, 0.5, 0.5)));
  await page.locator("#readout .readout-place span").first().waitFor();
  await page.mouse.move(3, 3);
  const { revision } = wire.frame;
  await slide(slider(page, "kappa2"), 0.9);
  await changed(wire, revision);
  await named(page);
  await pictures(page, 5);
  const all = await shifts();
  const sum = all.reduce((total, one) => total + one.value, 0);
  assert.ok(sum < MOST_SHIFT, `layout shifts of ${sum}: ${JSON.stringify(all, null, 1)}`);
}));

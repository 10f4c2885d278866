/** The tour, and the page within another one. */

import assert from "node:assert/strict";
import { once } from "node:events";
import { createServer } from "node:http";
import { test } from "node:test";
import { LIGHT, ofDriver, shoot, stage, upon } from "./stage.mjs";
import { moves, named, pictures, seen, until } from "./waits.mjs";

const it = stage();

test("an address begins the tour at a step, and keys go through it", upon(it, { hash: "tour=3" }, async ({ page, wire }) => {
  await seen(page, wire, "fig3");
  assert.equal(await page.locator("#tour-count").textContent(), "Step 3 of 9");
  await page.waitForFunction(() => document.querySelector("#returns-ahead").hasAttribute("data-tour-target"));
  await page.locator("#tour-next").focus();
  await page.keyboard.press("Enter");
  await until(() => wire.last.get("begun").preset === "fig4", "the next step");
  assert.equal(await page.evaluate(() => document.activeElement.id), "tour-title", "read from its title");
  await page.waitForFunction(() => /tour=4/.test(location.hash));
  await page.goBack();
  await until(() => wire.last.get("begun").preset === "fig3", "the step before, by Back");
  assert.equal(await page.locator("#tour-count").textContent(), "Step 3 of 9");
  await page.locator("#tour-title").focus();
  await page.keyboard.press("Escape");
  await page.locator("#tour").waitFor({ state: "hidden" });
  assert.equal(await page.evaluate(() => document.activeElement.id), "tour-open");
  await page.waitForFunction(() => !/tour=/.test(location.hash));
  assert.equal(await page.locator("#toasts li").count(), 0);
}));

/** What the body of each step is, where the sentence says so. */
const MOTIONS = { 2: "rectangular", 3: "quasi-periodic", 5: "zigzag", 7: "zigzag", 8: "pulsating-straight", 9: "blow-up" };

test("every step is what it says, and has its thing to try", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#tour-open").click();
  for (let step = 1; step <= 9; step++) {
    await page.locator("#tour-count").filter({ hasText: `Step ${step} of 9` }).waitFor();
    await page.waitForFunction(() => document.querySelector("[data-tour-target]") !== null);
    await until(() => wire.frame?.revision >= wire.last.get("begun").revision, "the body");
    if (MOTIONS[step]) assert.equal(await named(page, MOTIONS[step]), MOTIONS[step]);
    await shoot(page, `tour-${step}`);
    await page.locator("#tour-next").click();
  }
  await page.locator("#tour").waitFor({ state: "hidden" });
}));

test("?embed shows the wanted panels in a frame of another page; any other address refuses to be framed", upon(it, { hash: LIGHT }, async ({ page, wire, server, browser }) => {
  await moves(page, wire);
  const frame = (address) => `<iframe src="${address}" width="640" height="420"></iframe>`;
  const elsewhere = createServer((request, response) => response.setHeader("content-type", "text/html").end(`<!doctype html><title>elsewhere</title>${frame(request.url === "/plain" ? server.address : `${server.address}?embed=body,map#${LIGHT}`)}`));
  elsewhere.listen(0, "127.0.0.1");
  await once(elsewhere, "listening");
  const origin = `http://127.0.0.1:${elsewhere.address().port}`;
  const slides = await browser.newPage({ viewport: { width: 700, height: 480 } });
  await slides.goto(`${origin}/`);
  const inner = slides.frameLocator("iframe");
  await inner.locator("#regime[data-regime=zigzag]").waitFor();
  const [body, map, bar] = await Promise.all(["#body-panel", "#map-panel", "header"].map((id) => inner.locator(id).isVisible()));
  assert.deepEqual([body, map, bar], [true, true, false]);
  assert.equal(await inner.locator("#strips").isVisible(), false);
  const boxes = await Promise.all(["#body-panel", "#map-panel"].map((id) => inner.locator(id).boundingBox()));
  assert.ok(boxes.every((box) => box.width > 250 && box.height > 350), JSON.stringify(boxes));
  await pictures(page, 5);
  await shoot(slides, "embed");
  await slides.goto(`${origin}/plain`);
  await slides.waitForLoadState();
  assert.equal(await slides.frameLocator("iframe").locator("#body").count(), 0);
  await slides.close();
  elsewhere.close();
}));

test("?embed stands in a sandboxed frame, which has no origin", upon(it, { hash: LIGHT }, async ({ page, wire, server, browser }) => {
  await moves(page, wire);
  const elsewhere = createServer((_, response) => response.setHeader("content-type", "text/html").end(`<!doctype html><title>elsewhere</title><iframe sandbox="allow-scripts" src="${server.address}?embed=body,map#${LIGHT}" width="640" height="420"></iframe>`));
  elsewhere.listen(0, "127.0.0.1");
  await once(elsewhere, "listening");
  const slides = await browser.newPage({ viewport: { width: 700, height: 480 } });
  const faults = [];
  slides.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  slides.on("pageerror", (error) => faults.push(String(error)));
  await slides.goto(`http://127.0.0.1:${elsewhere.address().port}/`);
  await slides.frameLocator("iframe").locator("#regime[data-regime=zigzag]").waitFor();
  await pictures(slides, 5);
  await shoot(slides, "sandboxed");
  await slides.close();
  elsewhere.close();
  assert.deepEqual(faults.filter((text) => !/icon\.svg|favicon/.test(text) && !ofDriver(text)), []);
}));

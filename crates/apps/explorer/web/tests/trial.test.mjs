/** What readers stumbled over in a trial: each is tried again here, as they did it. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { LIGHT, onlyIn, shoot, stage, upon, visit } from "./stage.mjs";
import { changed, mapped, moves, named, number, pictures, seen, slide, slider, stands, until } from "./waits.mjs";

const it = stage();
const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

/** In the page: as many more connections as a page has, so that they count as pages do. */
function connect(count) {
  const address = new URL("live", document.baseURI);
  address.protocol = address.protocol.replace("http", "ws");
  address.hash = "";
  const open = (socket) => new Promise((done) => socket.addEventListener("open", done));
  window.more = Array.from({ length: count }, () => new WebSocket(address));
  return Promise.all(window.more.map(open)).then(() => count);
}

test("a ninth page says that eight are open, over no black panel, and connects once there is room", async () => {
  const guests = [];
  for (let k = 0; k < 2; k++) guests.push(await visit(it, { hash: `${LIGHT}&play=0` }));
  for (const { page, wire } of guests) await seen(page, wire);
  assert.equal(await guests[0].page.evaluate(connect, 6), 6);
  const ninth = await visit(it, { hash: LIGHT });
  await ninth.page.locator("#banner-full").waitFor();
  assert.match(await ninth.page.locator("#banner").innerText(), /Eight pages/);
  assert.equal(await ninth.page.locator("#banner-stopped").isVisible(), false);
  const darkest = await ninth.page.evaluate(() => {
    const canvas = document.getElementById("body");
    return Math.min(...canvas.getContext("2d").getImageData(canvas.width / 4, canvas.height / 4, 40, 40).data);
  });
  assert.ok(darkest > 100, `${darkest}`);
  await shoot(ninth.page, "ninth");
  await guests.pop().leave();
  await seen(ninth.page, ninth.wire);
  await ninth.page.locator("#banner").waitFor({ state: "hidden" });
  await ninth.leave();
  for (const guest of guests) await guest.leave();
});

/** A finger that moves from one place to another on the screen. */
async function swipe(page, [x, y], [dx, dy]) {
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  await touch("touchStart", [{ x, y }]);
  for (let k = 1; k <= 8; k++) await touch("touchMove", [{ x: x + (dx * k) / 8, y: y + (dy * k) / 8 }]);
  await touch("touchEnd", []);
}

test("a finger that moves upwards on the picture of the body scrolls the page; across, it moves the view", onlyIn("chromium", "touches"), upon(it, { hash: LIGHT, ...PHONE }, async ({ page, wire }) => {
  await moves(page, wire);
  const { x, y, width, height } = await page.locator("#body").boundingBox();
  await swipe(page, [x + 0.1 * width, y + 0.85 * height], [4, -150]);
  await page.waitForFunction(() => window.scrollY > 20);
  assert.equal(await page.locator("#follow").getAttribute("aria-pressed"), "true");
  await page.evaluate(() => window.scrollTo(0, 0));
  await swipe(page, [x + 0.1 * width, y + 0.85 * height], [120, 6]);
  await page.locator("#follow[aria-pressed=false]").waitFor();
}));

test("with a finger the hints speak of tapping", upon(it, { hash: LIGHT, ...PHONE }, async ({ page, wire }) => {
  await moves(page, wire);
  assert.match(await page.locator("#readout").innerText(), /^Tap/);
  assert.doesNotMatch(await page.locator("#readout").innerText(), /wheel|Point/);
}));

test("Back returns to the place before, Forward to the one after", upon(it, { hash: "preset=fig5a" }, async ({ page, wire }) => {
  await seen(page, wire, "fig5a");
  await page.getByTestId("preset-fig6b").click();
  await seen(page, wire, "fig6b");
  await page.goBack();
  await seen(page, wire, "fig5a");
  assert.match(page.url(), /preset=fig5a/);
  await page.goForward();
  await seen(page, wire, "fig6b");
}));

test("a number that cannot be read is said to be none", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  const field = number(page, "kappa2");
  const before = await field.inputValue();
  const refusal = page.locator('[data-parameter="kappa2"] .refusal');
  for (const [typed, says] of [["0,9", /0,9.*point.*0\.9/], ["1e999", /1e999.*too large/], ["abc", /abc.*not a number/], ["", /type a number/]]) {
    await field.fill(typed);
    await field.press("Enter");
    await refusal.filter({ hasText: says }).waitFor();
    assert.equal(await field.inputValue(), typed, "what was typed stays to be mended");
  }
  assert.ok(!wire.said.has("set"));
  await field.blur();
  assert.equal(await field.inputValue(), before);
  const { revision } = wire.frame;
  await field.fill("\u22120.25");
  await field.press("Enter");
  await changed(wire, revision);
  assert.equal(wire.last.get("changed").parameters.kappa2, -0.25);
  assert.equal(await refusal.isVisible(), false);
}));

test("under a cycle that attracts the largest exponent has an error that includes 0", upon(it, { hash: "preset=fig2&x=kappa2:0.15:0.2&y=none" }, async ({ page, wire }) => {
  await named(page, "rectangular");
  await until(() => wire.last.get("exponents")?.done, "the exponents");
  const [{ value, error }] = wire.last.get("exponents").exponents;
  assert.ok(Math.abs(value) <= error, `${value} +- ${error}`);
}));

test("a steady circle has no spectrum", upon(it, { hash: "preset=fig4&kappa2=0.3&kappa3=0.6&x=kappa2:1.2:1.6&y=kappa3:0.7:1" }, async ({ page, wire }) => {
  await named(page, "circular");
  await until(() => wire.last.get("strips")?.samples > 600, "samples");
  assert.deepEqual(wire.last.get("strips").spectra, []);
  await page.locator("#spectrum-empty").filter({ hasText: "steady" }).waitFor();
}));

test("300 returns come at once", upon(it, { hash: "preset=fig3&x=kappa2:0.1:0.2&y=gamma:-0.1:-0.05" }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#play").click();
  const { t } = await stands(page, wire);
  await page.locator("#returns-ahead").click();
  await page.waitForFunction(() => Number(document.getElementById("returns").dataset.points) >= 300);
  assert.equal(wire.frame.t, t, "the body stays");
  await shoot(page, "returns");
}));

test("while a parameter is changed the body has the name of the map", upon(it, { hash: "preset=fig4&kappa2=1.5&kappa3=0.85&x=kappa2:1.2:1.6&y=kappa3:0.7:1" }, async ({ page, wire }) => {
  await mapped(page);
  await named(page);
  await page.evaluate(() => {
    window.names = new Set();
    new MutationObserver(() => window.names.add(document.getElementById("regime").textContent)).observe(document.getElementById("regime"), { childList: true, characterData: true, subtree: true, attributes: true });
  });
  const { revision } = wire.frame;
  await slide(slider(page, "kappa2"), 1.3);
  await changed(wire, revision);
  await named(page);
  assert.ok(!(await page.evaluate(() => [...window.names])).some((name) => name.startsWith("classifying")));
}));

test("the cells about the body are the first of the map", upon(it, { hash: "preset=fig5a" }, async ({ page, wire }) => {
  await seen(page, wire);
  await until(() => wire.cells.length > 0, "cells");
  const map = wire.last.get("map");
  const { kappa2, kappa3 } = wire.last.get("begun").parameters;
  const [i, j] = [(kappa2 - map.x.first) / map.x.step, (kappa3 - map.y.first) / map.y.step].map(Math.round);
  const about = ([column, row]) => Math.abs(column - i) <= 1 && Math.abs(row - j) <= 1;
  // Some take longer than others. Most of the nine are of the finest level, which makes up three quarters of the map and comes last elsewhere.
  const places = (cells) => new Set(cells.filter(about).map(String)).size;
  await until(() => places(wire.cells) >= 5, "cells about the body");
  // In the order of arrival: a whole map may take less time than a look at it.
  const fifth = wire.cells.findIndex((_, last) => places(wire.cells.slice(0, last + 1)) >= 5);
  const before = new Set(wire.cells.slice(0, fifth).map(String)).size;
  assert.ok(before < (map.x.count * map.y.count) / 2, `${before} of ${map.x.count * map.y.count} cells came before`);
}));

test("long numbers along the axes leave room for their titles", upon(it, { hash: "preset=fig5a&x=kappa2:0.80001:0.80012&y=kappa3:0.50001:0.50021", own: true, viewport: { width: 1440, height: 900 } }, async ({ page, wire }) => {
  await page.addInitScript(() => {
    const { prototype } = CanvasRenderingContext2D;
    const { fillText } = prototype;
    window.cut = [];
    prototype.fillText = function (text, x, y) {
      const { canvas } = this;
      if (canvas.id === "map" || canvas.id === "returns") {
        const { width } = this.measureText(text);
        const from = this.textAlign === "right" ? x - width : this.textAlign === "center" ? x - width / 2 : x;
        const { a, b, c, d, e, f } = this.getTransform();
        for (const [u, v] of [[from, y - 8], [from + width, y]]) {
          const [p, q] = [a * u + c * v + e, b * u + d * v + f];
          if (p < 0 || q < 0 || p > canvas.width || q > canvas.height) window.cut.push(`${canvas.id}: ${text} at ${p}, ${q}`);
        }
      }
      return fillText.call(this, text, x, y);
    };
  });
  await page.reload();
  await mapped(page);
  await pictures(page, 5);
  await page.evaluate(() => (window.cut = []));
  await page.locator("#theme").click(); // everything is drawn again
  await pictures(page, 10);
  assert.deepEqual(await page.evaluate(() => window.cut), []);
  assert.ok(wire.last.has("mapped"));
}));

test("the place of a cell has the digits that its path needs", upon(it, { hash: "preset=fig6a&x=length:6:7&y=none" }, async ({ page, wire }) => {
  await moves(page, wire);
  await until(() => wire.frame.t > wire.frames[0].t + 40, "some path");
  await pictures(page, 20);
  assert.match(await page.locator("#clock-x").textContent(), /\.\d{4}/);
}));

test("equations are in sight, with their indices", upon(it, { hash: LIGHT, viewport: { width: 1440, height: 900 } }, async ({ page, wire }) => {
  await moves(page, wire);
  const summary = page.locator(".equations > summary");
  assert.ok((await summary.boundingBox()).y < 300);
  await summary.click();
  const subscripts = await page.locator(".equation sub").allTextContents();
  assert.ok(["i", "ij", "ijk"].every((index) => subscripts.includes(index)), subscripts.join(" "));
}));

test("the key ? lists all keys", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.keyboard.press("?");
  await page.locator("#keys").waitFor();
  assert.match(await page.locator("#keys").innerText(), /play or pause/);
  await shoot(page, "keys");
  await page.keyboard.press("Escape");
  await page.locator("#keys").waitFor({ state: "hidden" });
  await page.locator("#keys-open").click();
  await page.locator("#keys").waitFor();
}));

test("words of the verdict have a definition, by pointer and by key", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  await named(page, "zigzag");
  const word = page.locator("#why dfn").filter({ hasText: "multiplier" });
  await word.hover();
  await page.locator("#definition").filter({ hasText: "periodic orbit" }).waitFor();
  await page.mouse.move(5, 5);
  await page.locator("#definition").waitFor({ state: "hidden" });
  await word.focus();
  await page.locator("#definition").waitFor();
  await page.keyboard.press("Escape");
  await page.locator("#definition").waitFor({ state: "hidden" });
}));

for (const [name, context] of [["1440", { viewport: { width: 1440, height: 900 } }], ["390", PHONE]]) {
  test(`${name} wide: whatever can be pressed is at least 24 pixels in size`, upon(it, { hash: LIGHT, ...context }, async ({ page, wire }) => {
    await moves(page, wire);
    await page.evaluate(() => document.querySelectorAll("details").forEach((one) => (one.open = true)));
    const small = await page.evaluate(() => [...document.querySelectorAll("button, summary, select, input, textarea")].filter((one) => one.checkVisibility()).map((one) => [one.id || one.className || one.getAttribute("aria-label"), one.getBoundingClientRect()]).filter(([, box]) => box.width > 0 && (box.width < 24 || box.height < 24)).map(([what, box]) => `${what} ${box.width} x ${box.height}`));
    assert.deepEqual(small, []);
  }));
}

/** For everybody: names for screen readers, an order for the tab key, contrast, light and dark. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { assertAccessible } from "./axe.mjs";
import { LIGHT, onlyIn, stage, upon, visit } from "./stage.mjs";
import { moves, named, number, seen } from "./waits.mjs";

const it = stage();
const NAMED = new Set(["button", "checkbox", "combobox", "slider", "spinbutton", "textbox", "link", "progressbar", "img", "application", "Canvas", "DisclosureTriangle", "listbox", "dialog"]);

test("everything that can be used or seen has a name", onlyIn("chromium", "the tree of accessibility"), upon(it, { hash: LIGHT, own: true }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#share-menu > summary").click();
  const session = await page.context().newCDPSession(page);
  const { nodes } = await session.send("Accessibility.getFullAXTree");
  const useful = nodes.filter((node) => !node.ignored && NAMED.has(node.role?.value));
  assert.ok(useful.length > 80, `${useful.length} nodes`);
  const nameless = useful.filter((node) => !node.name?.value?.trim());
  const described = await Promise.all(nameless.map(async ({ role, backendDOMNodeId }) => {
    const { node } = await session.send("DOM.describeNode", { backendNodeId: backendDOMNodeId });
    return `${role.value}: <${node.localName} ${(node.attributes ?? []).join(" ")}>`;
  }));
  assert.deepEqual(described, []);
  const names = useful.filter((node) => node.role.value === "button").map((node) => node.name.value);
  assert.ok(["Pause", "Restart"].every((name) => names.includes(name)), names.join("; "));
}));

test("the tab key meets map, body and sliders in this order", upon(it, { hash: LIGHT }, async ({ page, wire }) => {
  await moves(page, wire);
  const met = [];
  for (let k = 0; k < 150 && met.at(-1) !== "kappa3"; k++) {
    await page.keyboard.press("Tab");
    met.push(await page.evaluate(() => document.activeElement.id || document.activeElement.getAttribute("aria-label") || document.activeElement.textContent));
  }
  const places = ["fig1", "x-axis", "map", "play", "speed", "kappa2"].map((name) => met.findIndex((one) => one === name || one.startsWith(`${name}:`)));
  assert.ok(places.every((place, k) => place > (places[k - 1] ?? -1)), `${places} of ${met.join(", ")}`);
  const ring = await page.evaluate(() => {
    const style = getComputedStyle(document.activeElement);
    return style.outlineStyle !== "none" || style.boxShadow !== "none";
  });
  assert.ok(ring, "the focus can be seen");
}));

/** Contrast of texts with what is behind them, by WCAG 2: element, ratio. */
function contrasts(page, selectors) {
  return page.evaluate((all) => {
    const context = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
    const rgba = (colour) => {
      context.clearRect(0, 0, 1, 1);
      context.fillStyle = colour;
      context.fillRect(0, 0, 1, 1);
      return [...context.getImageData(0, 0, 1, 1).data];
    };
    const luminance = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)).reduce((sum, c, k) => sum + c * [0.2126, 0.7152, 0.0722][k], 0);
    const behind = (element) => {
      for (let one = element; one; one = one.parentElement) {
        const colour = rgba(getComputedStyle(one).backgroundColor);
        if (colour[3] === 255) return colour;
      }
      return [255, 255, 255, 255];
    };
    return all.map((selector) => {
      const element = document.querySelector(selector);
      if (!element) return [selector, NaN];
      const [a, b] = [luminance(rgba(getComputedStyle(element).color)), luminance(behind(element))];
      return [selector, (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05)];
    });
  }, selectors);
}

const TEXTS = ["h1", "#about", ".chip", ".chip[aria-pressed=true]", "#connection-text", "#regime", "#why", "#clock-t", "#clock", "#readout", "#map-legend li", "#map-progress-text", "#speed-value", "#follow", "fieldset legend", ".symbol-button", ".parameter input.number", ".axis-name", "#map-reset", "#show-map", "#show-branches", ".refusal", "#x-axis", "#true-size"];

for (const colorScheme of ["light", "dark"]) {
  test(`${colorScheme}: texts stand out`, upon(it, { hash: LIGHT, colorScheme }, async ({ page, wire }) => {
    await moves(page, wire);
    await named(page);
    await page.locator("#map-legend li").first().waitFor();
    await number(page, "kappa2").fill("1e7");
    await number(page, "kappa2").press("Enter");
    await page.locator(".refusal:visible").waitFor();
    const faint = (await contrasts(page, TEXTS)).filter(([, ratio]) => !(ratio >= 4.5));
    assert.deepEqual(faint, []);
  }));
}

/** How bright the page is, 0 to 255. */
const brightness = (page) => page.evaluate(() => Number(getComputedStyle(document.body).backgroundColor.match(/\d+/)[0]));

test("light or dark as the system says, until the reader says otherwise", onlyIn("chromium", "colours of the system"), async () => {
  const { page, wire, leave } = await visit(it, { hash: LIGHT, colorScheme: "dark" });
  await seen(page, wire);
  assert.ok((await brightness(page)) < 60);
  await page.emulateMedia({ colorScheme: "light" });
  await page.waitForFunction(() => Number(getComputedStyle(document.body).backgroundColor.match(/\d+/)[0]) > 200);
  await page.locator("#theme").click();
  assert.ok((await brightness(page)) < 60);
  await page.reload();
  await seen(page, wire);
  assert.ok((await brightness(page)) < 60, "the choice is kept");
  await leave();
});

const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

for (const [name, context] of [["a desktop", {}], ["a phone", PHONE], ["a phone with the legend of Fig. 1", { ...PHONE, hash: "preset=fig1" }]]) {
  test(`axe finds nothing on ${name}`, upon(it, { hash: LIGHT, ...context }, async ({ page, wire }) => {
    await moves(page, wire);
    await named(page);
    await assertAccessible(page);
  }));
}

/** What the page says of bodies that are noisy, tiny, or have long names: nothing is cut, and nothing is said that is not so. */

import assert from "node:assert/strict";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { shoot, stage, upon } from "./stage.mjs";
import { moves, named, number, pictures, seen, slide, until } from "./waits.mjs";

/** A circle of radius about 1e-4 whose parameters have long names and many digits. */
const TEXT = `title = "A tiny body"
[model.amplitudes]
modes = [1]
[model.amplitudes.parameters]
gamma = 0.4982946571290721
rate_of_turning_of_the_velocity_left = 0.3
[model.amplitudes.equations]
z1 = "(gamma + i*rate_of_turning_of_the_velocity_left - |z1|^2*1e8)*z1"
`;
const file = join(mkdtempSync(join(tmpdir(), "motiform-")), "tiny.toml");
writeFileSync(file, TEXT);
const it = stage({ file });

test("the name of a noisy body is that of the equations without noise, and its heading has no rate", upon(it, { hash: "model=noisy-heading" }, async ({ page, wire }) => {
  await moves(page, wire);
  assert.equal(await page.locator("#noise-value").textContent(), "0.2", "of the velocity alone");
  await named(page, "straight");
  assert.match(await page.locator("#why").textContent(), /^the equations without noise: /);
  await page.locator(".series-empty:visible").getByText("noise").waitFor();
  await slide(page.locator("#noise"), 0);
  await until(() => wire.last.get("changed")?.noise === 0, "no noise");
  await page.locator(".series-empty:visible").waitFor({ state: "hidden" });
  await named(page, "straight");
  assert.doesNotMatch(await page.locator("#why").textContent(), /noise/);
}));

test("sentences of presets are set as symbols", upon(it, { hash: "model=chiral" }, async ({ page, wire }) => {
  await seen(page, wire);
  const about = page.locator("#about-text");
  assert.match(await about.textContent(), /turning \u03c9:.*\u03c9 \u2192 -\u03c9/);
  assert.match(await page.locator("#series").textContent(), /turning raterad\/time/, "no second omega");
  for (const [model, text] of [["elongating-field", /\(EiEj|\(Ei Ej/], ["noisy-heading", /noise2\/\(2 \u03b3\)/]]) {
    await page.locator("#model").selectOption(model);
    await about.getByText(text).waitFor();
    assert.doesNotMatch(await about.textContent(), /[_^]|->|gamma/);
  }
}));

/** What is cut in its place: the element, its width and what it holds. */
function cut(page, selector) {
  return page.locator(selector).evaluateAll((all) => all.filter((one) => one.checkVisibility() && one.scrollWidth > one.clientWidth + 1).map((one) => `${one.className} ${one.value ?? one.textContent}: ${one.scrollWidth} in ${one.clientWidth}`));
}

for (const [width, height] of [[1400, 900], [800, 900]]) {
  test(`${width} wide: long names, many digits and small numbers have room`, upon(it, { hash: "model=tiny.toml", viewport: { width, height } }, async ({ page, wire }) => {
    await moves(page, wire);
    await named(page, "circular");
    assert.deepEqual(await cut(page, ".parameter > *, .series-name, .panel-head button"), []);
    assert.equal(await number(page, "gamma").inputValue(), "0.4982947");
    await number(page, "gamma").focus();
    assert.equal(await number(page, "gamma").inputValue(), "0.4982946571290721", "all digits where one writes");
    await number(page, "gamma").blur();
    assert.match(await page.locator(".series-power").first().textContent(), /^10\u207b/);
    for (const id of ["x-axis", "y-axis"]) assert.ok(await page.locator(`label:has(#${id}) .field-name`).isVisible(), id);
    const [button, text] = await page.locator("#map-reset").evaluate((one) => {
      const range = document.createRange();
      range.selectNodeContents(one);
      return [one, range].map((part) => part.getBoundingClientRect().width);
    });
    assert.ok(text < button, "the button holds its word");
    await pictures(page, 4);
    await shoot(page, `tiny-${width}`);
  }));
}

test("a long sentence ends with a button that shows the rest", upon(it, { hash: "preset=fig6a", viewport: { width: 800, height: 900 } }, async ({ page, wire }) => {
  await moves(page, wire);
  await named(page, "chaotic");
  const hidden = () => page.locator("#why").evaluate((one) => one.scrollHeight > one.clientHeight + 1);
  assert.ok(await hidden());
  await page.locator("#why-more").click();
  assert.ok(!(await hidden()));
  await page.locator("#why-more").click();
  assert.ok(await hidden());
}));

/** Equations given as text: a study file that the explorer opens, and the editor of the page. */

import assert from "node:assert/strict";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { denied, shoot, stage, upon } from "./stage.mjs";
import { moves, named, seen } from "./waits.mjs";

const TEXT = `title = "A handed circle"
[model.amplitudes]
modes = [1] # the velocity alone
[model.amplitudes.parameters]
gamma = { value = 0.5, range = [0.1, 1.0] }
omega = { value = 0.3, range = [-1, 1], symbol = "ω", text = "handedness" }
[model.amplitudes.equations]
z1 = "(gamma + i*omega - |z1|^2)*z1"
[run]
noise = 0.01
`;
const file = join(mkdtempSync(join(tmpdir(), "motiform-")), "my.toml");
writeFileSync(file, TEXT);
const it = stage({ file });

const editor = (page) => page.locator("#editor-text");
async function edit(page) {
  await page.locator(".equations > summary").click();
  await page.getByTestId("edit-equations").click();
  await editor(page).waitFor();
}

test("a study file gives the page its sliders, its noise and its map", upon(it, { hash: "model=my.toml" }, async ({ page, wire }) => {
  await seen(page, wire);
  assert.equal(await page.locator("#model").inputValue(), "my.toml");
  assert.equal(await page.title(), "A handed circle \u2013 motiform");
  assert.equal(await page.locator("#noise-value").textContent(), "0.01");
  assert.deepEqual(await page.locator("#parameters input.number").evaluateAll((all) => all.map((one) => one.value)), ["0.5", "0.3"]);
  await moves(page, wire);
  assert.equal(await named(page), "circular");
  await shoot(page, "my-toml");
  await page.locator("#share-menu summary").click();
  await page.locator("#share-command").click();
  await page.waitForFunction(() => document.querySelector("#dialog").open);
  const command = await page.locator("#dialog-text").textContent();
  assert.match(command, /^motiform simulate \S*my\.toml --initial v1=/);
  assert.doesNotMatch(command, /--noise/, "the file has it");
}));

test("a mistake is marked at its place, and equations that are right run", upon(it, { hash: "model=my.toml" }, async ({ page, wire }) => {
  await seen(page, wire);
  await edit(page);
  assert.equal(await editor(page).inputValue(), TEXT, "as it was given, comments included");
  await editor(page).fill(TEXT.replace("gamma + i*omega", "gama + i*omega"));
  await page.locator("#editor-run").click();
  await page.locator("#editor-mistake").waitFor();
  assert.match(await page.locator("#editor-mistake").textContent(), /^Line 8, column 8: .*gama.*gamma/);
  const marked = await editor(page).evaluate((area) => area.value.slice(area.selectionStart, area.selectionEnd));
  assert.equal(marked, "gama");
  await shoot(page, "mistake");
  await editor(page).fill(TEXT.replace("0.3", "-0.3").replace("handed circle", "circle, changed"));
  await page.keyboard.press("Control+Enter");
  await page.waitForFunction(() => document.title.startsWith("A circle, changed"));
  await moves(page, wire);
  assert.equal(await named(page), "circular");
  assert.equal(await page.locator("#model").inputValue(), "edited");
  await page.waitForFunction(() => location.hash.startsWith("#model=edited"));
  await page.reload();
  await page.waitForFunction(() => document.title.startsWith("A circle, changed"));
}));

test("the tensor model is changed as text", upon(it, { hash: "preset=fig5a&x=kappa2:1.2:1.6&y=kappa3:0.7:1" }, async ({ page, wire }) => {
  await seen(page, wire, "fig5a");
  await edit(page);
  const text = await editor(page).inputValue();
  assert.match(text, /b2\*conj\(z1\)\*z3/);
  assert.doesNotMatch(text, /b4/, "couplings that are zero are left out");
  await editor(page).fill(text.replace("gamma*z1", "gamma*z1 + i*omega*z1").replace("[model.amplitudes.parameters]", "[model.amplitudes.parameters]\nomega = 0.02"));
  await page.locator("#editor-run").click();
  await page.waitForFunction(() => document.querySelector("#model").value === "edited");
  await moves(page, wire);
  assert.ok(await page.locator("[data-name=omega], [data-parameter=omega]").count());
  await shoot(page, "edited");
}));

test("where storage is denied the page works, and equations last as long as it does", upon(it, { hash: "model=my.toml", own: true }, async ({ page, wire }) => {
  await page.addInitScript(denied);
  await page.reload();
  await moves(page, wire);
  await named(page, "circular");
  await edit(page);
  await editor(page).fill(TEXT.replace("0.3", "-0.3").replace("handed circle", "circle, changed"));
  await page.locator("#editor-run").click();
  await page.waitForFunction(() => document.title.startsWith("A circle, changed"));
  await moves(page, wire);
  await page.locator("#theme").click();
  await page.locator("#compare").click();
  await page.locator("#twin").waitFor();
  await page.waitForFunction(() => window.motiform.beside() !== null);
}));

test("a study that is too long to be sent is refused in the editor, and the connection stays", upon(it, { hash: "model=my.toml" }, async ({ page, wire }) => {
  await moves(page, wire);
  await edit(page);
  const sent = wire.count("define");
  const head = JSON.stringify({ do: "define", text: "" }).length;
  const rest = 32 * 1024 - head - JSON.stringify(TEXT).length + 2;
  // Bytes, not characters: the text has an omega.
  await editor(page).fill(`${TEXT}#${"x".repeat(rest - 1)}`);
  await page.locator("#editor-run").click();
  await page.locator("#editor-mistake").waitFor();
  assert.match(await page.locator("#editor-mistake").textContent(), /too long.*33 kB of at most 32 kB.*motiform explore FILE/);
  assert.equal(wire.count("define"), sent);
  await moves(page, wire);
  assert.equal(await page.locator("#connection").getAttribute("data-state"), "open");
  await editor(page).fill(`${TEXT}#${"x".repeat(rest - 2)}`);
  await page.locator("#editor-run").click();
  await page.waitForFunction(() => document.querySelector("#model").value === "edited");
}));

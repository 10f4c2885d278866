/** Everything that can be saved or copied is what it says it is. */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { test } from "node:test";
import { assertAllFiles, assertSvg } from "./files.mjs";
import { binary } from "./server.mjs";
import { LIGHT, saved, stage, upon } from "./stage.mjs";
import { moves } from "./waits.mjs";

const it = stage();

test("every button of Share and keep gives a valid file", upon(it, { hash: "preset=fig5b&x=kappa2:1.2:1.6&y=kappa3:0.7:1" }, async ({ page, wire, browser }) => {
  const judge = await browser.newPage(); // has no rules of its own about what may be parsed
  await moves(page, wire);
  await page.locator("#speed").focus();
  await page.keyboard.press("End");
  for (const id of ["spectrum-empty", "returns-empty", "exponents-empty"]) await page.locator(`#${id}`).waitFor({ state: "hidden" });
  await page.waitForFunction(() => document.getElementById("map-progress-bar").value > 0);
  await page.locator("#play").click();
  await page.locator("#share-menu > summary").click();
  await assertAllFiles(page, judge);
  await judge.close();
  assert.equal(await page.locator("#toasts li").count(), 0);
}));

test("a panel's own button saves its figure", upon(it, { hash: LIGHT }, async ({ page, wire, browser }) => {
  await moves(page, wire);
  await page.locator('details.save[data-figure="path"] > summary').click();
  const { path } = await saved(page, page.locator('[data-save="path.svg"]'));
  const judge = await browser.newPage();
  await assertSvg(judge, readFileSync(path, "utf8"));
  await judge.close();
}));

test("what cannot be made is said", upon(it, { hash: `${LIGHT}&play=0` }, async ({ page }) => {
  await page.waitForFunction(() => window.motiform?.position());
  await page.locator("#share-menu > summary").click();
  await page.locator('[data-export="return-map.svg"]').click();
  await page.locator("#toasts li").filter({ hasText: "return-map.svg" }).waitFor();
}));

async function text(page, which) {
  if (!(await page.locator("#share-menu[open]").count())) await page.locator("#share-menu > summary").click();
  await page.locator(`#share-${which}`).click();
  await page.locator("#dialog[open]").waitFor();
  const found = await page.locator("#dialog-text").textContent();
  await page.locator("#dialog-close").click();
  return found;
}

test("the command runs, the Python compiles", upon(it, { hash: `${LIGHT}&kappa2=0.8&noise=0.001` }, async ({ page, wire }) => {
  await moves(page, wire);
  await page.locator("#play").click();
  const folder = mkdtempSync(join(tmpdir(), "motiform-share-"));
  symlinkSync(binary(), join(folder, "motiform"));
  const env = { ...process.env, PATH: `${folder}${delimiter}${process.env.PATH}` };
  const command = await text(page, "command");
  assert.match(command, /^motiform simulate tensor /);
  const result = JSON.parse(execFileSync("sh", ["-c", `${command} --json`], { cwd: folder, env, encoding: "utf8" }));
  assert.equal(result.parameters.kappa2, 0.8);
  const python = join(folder, "body.py");
  writeFileSync(python, await text(page, "python"));
  execFileSync("python3", ["-m", "py_compile", python], { cwd: folder });
}));

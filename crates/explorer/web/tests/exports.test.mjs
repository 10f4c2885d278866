/** Everything that can be saved or copied is what it says it is. */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { test } from "node:test";
import { binary } from "./server.mjs";
import { LIGHT, stage, upon } from "./stage.mjs";
import { moves } from "./waits.mjs";

const it = stage();

/** Chunks of a PNG: kind and data. */
function chunks(bytes) {
  assert.deepEqual([...bytes.subarray(0, 8)], [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  const found = [];
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at)) {
    found.push([bytes.toString("latin1", at + 4, at + 8), bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at))]);
  }
  return found;
}

/** A picture that the browser itself decodes, between IHDR and IEND. */
async function assertPng(judge, bytes) {
  const kinds = chunks(bytes).map(([kind]) => kind);
  assert.ok(kinds[0] === "IHDR" && kinds.at(-1) === "IEND" && kinds.includes("IDAT"), kinds.join());
  const [, header] = chunks(bytes)[0];
  const size = await judge.evaluate(async (data) => {
    const picture = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], { type: "image/png" }));
    return [picture.width, picture.height];
  }, bytes.toString("base64"));
  assert.deepEqual(size, [header.readUInt32BE(0), header.readUInt32BE(4)]);
  assert.ok(size[0] > 100 && size[1] > 50, size.join(" x "));
}

async function assertSvg(judge, text) {
  const found = await judge.evaluate((source) => {
    const root = new DOMParser().parseFromString(source, "image/svg+xml").documentElement;
    const broken = root.querySelector("parsererror") ?? (root.localName === "parsererror" ? root : null);
    return { name: root.localName, size: ["width", "height"].map((side) => Number.parseFloat(root.getAttribute(side))), children: root.childElementCount, broken: broken?.textContent ?? null };
  }, text);
  assert.deepEqual([found.name, found.broken], ["svg", null]);
  assert.ok(found.size.every((side) => side > 0) && found.children > 0, JSON.stringify(found));
}

function assertCsv(text, what) {
  const [head, ...rows] = text.trim().split("\n").map((line) => line.split(","));
  assert.ok(head.length > 2 && head.every((name) => /^[a-z]\w*$/.test(name)), head.join());
  assert.ok(rows.length > 10 && rows.every((row) => row.length >= head.length), what);
  const columns = what === "motion.csv" ? head : ["kappa2", "kappa3"];
  for (const row of rows) for (const name of columns) assert.ok(Number.isFinite(Number.parseFloat(row[head.indexOf(name)])), `${name}: ${row}`);
}

async function assertFile(judge, what, path) {
  const [bytes, kind] = [readFileSync(path), what.split(".").pop()];
  assert.ok(bytes.length > 100, what);
  if (kind === "svg") return assertSvg(judge, bytes.toString());
  if (kind === "csv") return assertCsv(bytes.toString(), what);
  if (kind === "toml") return assert.match(execFileSync(binary(), ["check", path], { encoding: "utf8" }), /tensor/);
  await assertPng(judge, bytes);
  const kinds = chunks(bytes).map(([one]) => one);
  if (kind === "apng") assert.ok(kinds.includes("acTL") && kinds.filter((one) => one === "fcTL").length > 5, kinds.join());
}

test("every button of Share and keep gives a valid file", upon(it, { hash: "preset=fig5b&x=kappa2:1.2:1.6&y=kappa3:0.7:1" }, async ({ page, wire, browser }) => {
  const judge = await browser.newPage(); // has no rules of its own about what may be parsed
  await moves(page, wire);
  await page.locator("#speed").focus();
  await page.keyboard.press("End");
  for (const id of ["spectrum-empty", "returns-empty", "exponents-empty"]) await page.locator(`#${id}`).waitFor({ state: "hidden" });
  await page.waitForFunction(() => document.getElementById("map-progress-bar").value > 0);
  await page.locator("#play").click();
  await page.locator("#share-menu > summary").click();
  const files = await page.locator("[data-export]:visible").evaluateAll((all) => all.map((one) => one.dataset.export));
  assert.ok(files.length >= 16, files.join());
  const folder = mkdtempSync(join(tmpdir(), "motiform-files-"));
  for (const what of files) {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`[data-export="${what}"]`).click()]);
    assert.equal(download.suggestedFilename(), what === "study.toml" ? download.suggestedFilename() : `motiform-fig5b-${what}`);
    const path = join(folder, what);
    await download.saveAs(path);
    await assertFile(judge, what, path);
  }
  await judge.close();
  assert.equal(await page.locator("#toasts li").count(), 0);
}));

test("a panel's own button saves its figure", upon(it, { hash: LIGHT }, async ({ page, wire, browser }) => {
  await moves(page, wire);
  await page.locator('details.save[data-figure="path"] > summary').click();
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator('[data-save="path.svg"]').click()]);
  const judge = await browser.newPage();
  await assertSvg(judge, readFileSync(await download.path(), "utf8"));
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

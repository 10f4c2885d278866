/** Saved files are what their endings say. */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { binary } from "./server.mjs";
import { saved } from "./stage.mjs";

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

/** A drawing that the browser parses. */
export async function assertSvg(judge, text) {
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

/** A file that is what its ending says; `judge` is an empty page. */
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

/** Saves every visible file of Share and keep, whose menu is open. */
export async function assertAllFiles(page, judge) {
  const files = await page.locator("[data-export]:visible").evaluateAll((all) => all.map((one) => one.dataset.export));
  assert.ok(files.length >= 16, files.join());
  for (const what of files) {
    const { name, path } = await saved(page, page.locator(`[data-export="${what}"]`));
    assert.equal(name, what === "study.toml" ? name : `motiform-fig5b-${what}`);
    await assertFile(judge, what, path);
  }
}

/** Numbers as the page writes them. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { transformWithOxc } from "vite";

const path = new URL("../src/numbers.ts", import.meta.url).pathname;
const { code } = await transformWithOxc(readFileSync(path, "utf8"), path);
const { fitting, given, inWords, pretty, scaledLabel, ticks, typeset, withError } = await import(`data:text/javascript;base64,${Buffer.from(code).toString("base64")}`);

test("a value has the digits of its error", () => {
  const cases = [
    [0.123456, 0.0123, "0.123 \u00b1 0.012"],
    [-123.456, 20, "\u2212123 \u00b1 20"],
    [-1e-4, 0.036, "0.000 \u00b1 0.036"],
    [2.89e-5, 9.7e-5, "0.000029 \u00b1 0.000097"],
    [7.33e-10, 2.2e-9, "(0.7 \u00b1 2.2)\u00b710\u207b\u2079"],
    [0.0997, 0.00996, "0.100 \u00b1 0.010"],
    [1, 0, "1 \u00b1 0"],
    [0.5, null, "0.5"],
  ];
  for (const [value, error, text] of cases) assert.equal(withError(value, error), text);
  assert.equal(withError(0.00886, 0.00042, "/s"), "(0.00886 \u00b1 0.00042)/s");
});

test("the numbers of an axis share a power of ten where they are small or large", () => {
  const small = ticks(8.4e-5, 9.6e-5, 3);
  assert.deepEqual([small.labels, small.power], [["8.5", "9.0", "9.5"], -5]);
  assert.deepEqual([ticks(0, 1, 2).labels, ticks(0, 1, 2).power], [["0.0", "0.5", "1.0"], 0]);
  assert.deepEqual(ticks(0, 2e6, 2).labels, ["0", "1", "2"]);
  assert.equal(scaledLabel("*v*", "m/s", -5), "*v* (10^{-5} m/s)");
  assert.equal(scaledLabel("*v*", null, 0), "*v*");
});

test("a field shows as many digits as it holds", () => {
  const cases = [[-0.39829465712907214, "-0.398295"], [0.0000123456789, "1.2346e-5"], [0.9, "0.9"], [-123456789.5, "-1.2346e8"], [0, "0"]];
  for (const [value, text] of cases) assert.equal(fitting(value, 9), text);
  assert.equal(pretty(-1.5e-9, 2), "\u22121.5\u00b710\u207b\u2079");
});

test("given numbers are those that were typed, names are words", () => {
  const values = Array.from({ length: 9 }, (_, k) => 0.1 + (0.6 - 0.1) * (k / 8));
  assert.deepEqual(values.map(given), ["0.1", "0.1625", "0.225", "0.2875", "0.35", "0.4125", "0.475", "0.5375", "0.6"]);
  assert.equal(given(0.47500000000000003), "0.475");
  assert.equal(given(0.4982946571290721), "0.4982946571290721", "all digits of what is no round number");
  const names = ["pulsating-straight", "quasi-periodic", "quasi-periodic, clockwise", "blow-up"];
  assert.deepEqual(names.map(inWords), ["pulsating straight", "quasi-periodic", "quasi-periodic, clockwise", "blow-up"]);
});

test("a time in a sentence has its unit where there is one", () => {
  const why = "zigzag; period 45.313103, largest multiplier -3.749e-1: stable; it stayed for a time of 2.5e3";
  assert.equal(typeset(why), "zigzag; period 45.313103, largest multiplier \u22120.3749: stable; it stayed for a time of 2500");
  assert.equal(typeset(why, "min"), "zigzag; period 45.313103 min, largest multiplier \u22120.3749: stable; it stayed for a time of 2500 min");
});

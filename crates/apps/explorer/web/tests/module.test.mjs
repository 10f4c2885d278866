/** The module computes what the program computes, to the bit: paths, names and numbers. */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { homedir, tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { Engine, rows, SITE } from "./engine.mjs";
import { moduleOf } from "../site.mjs";
import { binary } from "./server.mjs";

const CHECKOUT = join(dirname(fileURLToPath(import.meta.url)), "../../../../..");

const MODELS = [
  { model: "tensor", preset: "fig5a", state: [0.3, 0.1, 0.2, 0.05, 0.01, -0.02], t: 20 },
  { model: "cell", preset: "fig6a", state: null, t: 5 },
];

/** The coordinates of a model, and a state of it. */
function coordinates(engine, { model, state }) {
  const names = { tensor: ["v1", "v2", "s11", "s12", "u111", "u222"] }[model] ?? [];
  const preset = engine.hello.registry.presets.find((one) => one.name === "fig6a");
  const modes = preset.parameters.modes ?? 21;
  const all = names.length ? names : Array.from({ length: modes }, (_, k) => [`c${k + 1}`, `s${k + 1}`]).flat();
  return { names: all, values: state ?? all.map((_, k) => 0.2 * Math.cos(1.7 * k) * Math.exp(-0.5 * k)) };
}

function begun({ model, preset, state }) {
  const engine = new Engine();
  engine.hello = engine.next("hello");
  const start = coordinates(engine, { model, state });
  engine.say({ do: "begin", model, preset, parameters: {}, state: start.values, position: [0, 0], t: 0, noise: 0, seed: 1 });
  engine.begun = engine.next("begun");
  const initial = start.names.flatMap((name, k) => ["--initial", `${name}=${start.values[k]}`]);
  return { engine, initial };
}

const json = (...words) => JSON.parse(execFileSync(binary(), [...words, "--json"], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));

test("it asks for nothing but what its worker gives, and has no path of a machine in it", () => {
  const known = ["now", "text", "binary", "post", "back", "fault"].map((name) => `worker.${name}`);
  assert.deepEqual(Engine.imports().filter((name) => !known.includes(name)), []);
  const text = moduleOf(SITE).toString("latin1");
  for (const path of [`${homedir()}/`, CHECKOUT, "registry/src"]) assert.ok(!text.includes(path), path);
});

for (const one of MODELS) {
  test(`${one.model}: a body moves as the program moves it`, () => {
    const { engine, initial } = begun(one);
    const { sample, observables } = engine.begun;
    const folder = mkdtempSync(join(tmpdir(), "motiform-module-"));
    const common = ["simulate", one.model, "--preset", one.preset, ...initial, "--transient", "0", "--noise", "0", "--t-end", String(3 * one.t)];
    execFileSync(binary(), [...common, "--dt-out", String(sample), "--out", join(folder, "run"), "--format", "csv", "--no-figures"], { stdio: "ignore" });
    const [head, ...all] = readFileSync(join(folder, "run/trajectory.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
    const lines = all.filter((line) => Number(line[0]) <= one.t); // the last steps of a run end at its end
    rmSync(folder, { recursive: true });
    const columns = ["t", "x", "y", "speed", "turning_rate", ...observables.map((observable) => observable.name)].map((name) => head.indexOf(name));
    while (engine.binaries.flatMap(rows).length < lines.length) engine.say({ do: "advance", dt: 7 * sample });
    const found = engine.binaries.flatMap(rows).slice(0, lines.length);
    assert.ok(lines.length > 10);
    for (const [k, line] of lines.entries()) assert.deepEqual(found[k], columns.map((column) => Number(line[column])), `row ${k}`);
  });

  test(`${one.model}: its motion has the name and the numbers that the program gives`, () => {
    const { engine, initial } = begun(one);
    const found = engine.first("named"); // exponents to more digits would come after it
    const there = json("classify", one.model, "--preset", one.preset, ...initial);
    same(found, there);
  });
}

/** What is said of a motion, against `motiform classify --json`. */
function same({ regime, why, numbers }, there) {
  assert.deepEqual([regime, why], [there.regime, there.why]);
  const pairs = ["period", "margin", "time", "turning_rate", "drift"].map((name) => [name, numbers[name], there[name]]);
  pairs.push(["speed_mean", numbers.speed_mean, there.speed.mean], ["lambda_1", numbers.lambda_1, there.exponents?.[0]?.value]);
  for (const [name, a, b] of pairs) assert.equal(a ?? null, b ?? null, name);
}

test("cells of a map are those of the program", () => {
  const engine = new Engine();
  engine.say({ do: "begin", model: "tensor", preset: "fig1", parameters: {}, state: null, position: null, t: 0, noise: 0, seed: 1 });
  const { plane } = engine.next("hello").registry.presets.find((one) => one.name === "fig1");
  engine.say({ do: "map", epoch: 1, ...plane, count: 8 });
  const map = engine.next("map");
  engine.next("mapped");
  const regimes = new Set();
  for (let k = 0; k < map.x.count; k++) {
    engine.say({ do: "evidence", epoch: 1, cell: [k, k] });
    const evidence = engine.next("evidence");
    const set = Object.entries(evidence.parameters).flatMap(([name, value]) => ["--set", `${name}=${value}`]);
    same(evidence, json("classify", "tensor", "--preset", "fig1", ...set));
    regimes.add(evidence.regime);
  }
  assert.ok(regimes.size > 2, [...regimes].join());
});

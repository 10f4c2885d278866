/**
 * What the explorer costs, in numbers: `MOTIFORM=path node measure/measure.mjs`. Only correctness is asserted; times are printed,
 * since they belong to the machine. The load of the machine is printed with them.
 */

import assert from "node:assert/strict";
import { loadavg, cpus } from "node:os";
import { gzipSync } from "node:zlib";
import { Server } from "../tests/server.mjs";
import { launch, visit } from "../tests/stage.mjs";
import { mapTimes } from "./map.mjs";
import { Unwatched } from "./unwatched.mjs";

/** Seconds over which the costs of a playing page are averaged. */
const WINDOW = 10;

const row = (name, text) => console.log(`${name.padEnd(44)} ${text}`);
const server = await Server.start();
const browser = await launch();

try {
  row("machine", `${cpus().length} cores, load ${loadavg().map((one) => one.toFixed(1)).join(" ")}`);
  await size();
  await start();
  await map();
  for (const preset of ["fig5a", "fig3", "fig6a"]) await play(preset);
  for (const [preset, name] of [["fig1", "gamma"], ["fig5a", "kappa2"], ["fig6b", "length"]]) await drag(preset, name);
} finally {
  await browser.close();
  await server.stop();
}

/** Bytes of the page as they are, and as gzip would make them. */
async function size() {
  let [plain, packed] = [0, 0];
  for (const name of ["", "app.js", "app.css", "icon.svg"]) {
    const answer = await fetch(server.address + name);
    assert.equal(answer.status, 200);
    const bytes = Buffer.from(await answer.arrayBuffer());
    plain += bytes.length;
    packed += gzipSync(bytes, { level: 9 }).length;
  }
  row("size of the page", `${(plain / 1000).toFixed(0)} kB, compressed ${(packed / 1000).toFixed(0)} kB`);
}

/** From navigation to the first picture of the body, some times over. */
async function start() {
  const times = [];
  for (let k = 0; k < 5; k++) {
    const { page, leave } = await visit({ browser, server }, { hash: "preset=fig5a" });
    times.push(await page.evaluate(() => new Promise((done) => {
      const look = () => (window.motiform?.frames > 0 ? requestAnimationFrame(() => done(performance.now())) : requestAnimationFrame(look));
      look();
    })));
    await leave();
  }
  row("navigation to the first picture of the body", times.map((one) => `${(one / 1000).toFixed(2)} s`).join(", "));
}

async function map() {
  const page = await browser.newPage();
  await page.goto(`${server.address}icon.svg`); // our origin, without the work of the page
  const { cells, coarse, complete } = await mapTimes(page, `${server.address.replace("http", "ws")}live`, 64);
  assert.ok(cells >= 64 * 64, `${cells} cells`);
  row("map of figure 1, 64 x 64", `first look everywhere after ${coarse.toFixed(2)} s, all ${cells} cells after ${complete.toFixed(2)} s`);
  await page.close();
}

/** A page that plays, once everything else is computed. */
async function play(preset) {
  const begin = performance.now();
  const page = await Unwatched.open(`${server.address}#preset=${preset}`);
  await page.settled();
  row(`${preset}: named, mapped, exponents`, `after ${((performance.now() - begin) / 1000).toFixed(1)} s`);
  const { rate, main, renderer, all, own } = await page.shares(server.pid, WINDOW);
  assert.ok(rate > 0, "the body moves");
  const share = (part) => `${(100 * part).toFixed(1)} %`;
  row(`${preset}: playing`, `${rate.toFixed(1)} frames/s; of a core: server ${share(own)}, page ${share(renderer)} (its main thread ${share(main)}), all of Chromium ${share(all)}; load ${loadavg()[0].toFixed(1)}`);
  await page.close();
}

/** A slider in motion: every picture sets another value. */
async function drag(preset, name) {
  const page = await Unwatched.open(`${server.address}#preset=${preset}`);
  const rates = await page.dragged(name, 5);
  assert.ok(rates.changes > 0 && rates.frames > 0, "the body follows");
  row(`${preset}: ${name} dragged`, `${rates.frames.toFixed(1)} frames/s, ${rates.changes.toFixed(1)} changes/s; load ${loadavg()[0].toFixed(1)}`);
  await page.close();
}

/**
 * Plays for long and watches what grows: `MOTIFORM=path node measure/soak.mjs [minutes]`. Fails where, after the first quarter, the
 * server's memory, the page's heap or its number of nodes grows beyond these.
 */

import assert from "node:assert/strict";
import { Server } from "../tests/server.mjs";
import { launch, visit } from "../tests/stage.mjs";
import { moves, pixel, seen } from "../tests/waits.mjs";
import { residentMegabytes } from "./cost.mjs";

const MOST = { server: 30, heap: 15, nodes: 500 };
const MINUTE = 60_000;
const minutes = Number(process.argv[2] ?? 20);
assert.ok(minutes >= 4, "at least 4 minutes, or there is no quarter to compare with");

const server = await Server.start();
const browser = await launch();
const { page, wire, leave } = await visit({ browser, server }, { hash: "preset=fig5a" });
const session = await page.context().newCDPSession(page);
page.on("download", (file) => void file.delete());

let seed = 1;
/** The same numbers in each soak. */
const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
const pick = (list) => list[Math.floor(random() * list.length)];
const done = new Map();

const acts = {
  async preset() {
    const name = pick(await page.locator("[data-preset]").allTextContents());
    await page.locator(`[data-preset="${name}"]`).click();
    await seen(page, wire, name);
  },
  async slider() {
    await page.evaluate(([which, part]) => {
      const all = [...document.querySelectorAll("[data-parameter] input[type=range]")];
      const one = all[Math.floor(which * all.length)];
      const [low, high] = [Number(one.min), Number(one.max)];
      // Near its present value: most models far from their presets only blow up.
      one.value = String(one.valueAsNumber + (part - 0.5) * 0.1 * (high - low));
      one.dispatchEvent(new Event("input", { bubbles: true }));
    }, [random(), random()]);
  },
  async click() {
    const [x, y] = await place();
    await page.mouse.click(x, y);
  },
  async hover() {
    const [x, y] = await place();
    await page.mouse.move(x, y, { steps: 5 });
  },
  async zoom() {
    const [x, y] = await place();
    await page.mouse.move(x, y);
    await page.mouse.wheel(0, random() < 0.5 ? -150 : 150);
  },
  reset: () => page.locator("#map-reset").click(),
  kick: () => page.locator("#kick").click(),
  restart: () => page.locator("#restart").click(),
  async export() {
    await page.evaluate((part) => {
      const all = [...document.querySelectorAll("[data-export]")];
      all[Math.floor(part * all.length)].click();
    }, random());
  },
};

/** Somewhere in the map. */
async function place() {
  const view = await page.evaluate(() => window.motiform.map.window());
  return pixel(page, view.x0 + random() * (view.x1 - view.x0), view.y0 + random() * (view.y1 - view.y0));
}

/** What is in use, with the same body each time. */
async function sample() {
  await page.locator('[data-preset="fig5a"]').click();
  await seen(page, wire, "fig5a");
  await session.send("HeapProfiler.collectGarbage");
  const { usedSize } = await session.send("Runtime.getHeapUsage");
  const { nodes } = await session.send("Memory.getDOMCounters");
  return { server: residentMegabytes(server.pid), heap: usedSize / 2 ** 20, nodes };
}

const table = [];
const begin = performance.now();
console.log("minute  server MB  heap MB  nodes  acts");
for (let minute = 1; minute <= minutes; minute++) {
  while (performance.now() < begin + minute * MINUTE) {
    const name = pick(["preset", "slider", "slider", "click", "click", "hover", "zoom", "reset", "kick", "restart", "export"]);
    await acts[name]();
    done.set(name, (done.get(name) ?? 0) + 1);
    await new Promise((resolve) => setTimeout(resolve, 200 + 1800 * random()));
  }
  const now = await sample();
  table.push(now);
  const total = [...done.values()].reduce((sum, one) => sum + one, 0);
  console.log(`${String(minute).padStart(6)}  ${now.server.toFixed(1).padStart(9)}  ${now.heap.toFixed(1).padStart(7)}  ${String(now.nodes).padStart(5)}  ${String(total).padStart(4)}`);
}
console.log([...done].map(([name, count]) => `${name} ${count}`).join(", "));
await moves(page, wire);
await leave();
await browser.close();
await server.stop();

const [early, late] = [table[Math.floor(minutes / 4) - 1], table.at(-1)];
for (const [key, most] of Object.entries(MOST)) assert.ok(late[key] - early[key] <= most, `${key} grew from ${early[key]} to ${late[key]}`);

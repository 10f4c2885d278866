/** The page without a server: from a disk, from a static host under a sub-path, and in a frame. */

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { oneFile } from "../site.mjs";
import { assertAccessible } from "./axe.mjs";
import { SITE } from "./engine.mjs";
import { assertAllFiles } from "./files.mjs";
import { denied, launch, LIGHT, newTab, ofDriver, onlyIn, PATIENCE, shoot, vacate, VIEWPORT } from "./stage.mjs";

/** Where the static host has the page: it must not need the root. */
const PATH = "/talks/2026/";
const KINDS = { html: "text/html; charset=utf-8", js: "text/javascript", css: "text/css", svg: "image/svg+xml", gz: "application/gzip" };

/** Where the same host lets anybody read. */
const OPEN = "/open/";

/** Pages with a frame in them. */
const FRAMES = {
  "/lecture.html": `src="${PATH}?embed=body"`,
  "/sandboxed-one.html": 'sandbox="allow-scripts" src="/one.html?embed=body"',
  "/sandboxed-open.html": `sandbox="allow-scripts" src="${OPEN}?embed=body"`,
  "/sandboxed-closed.html": `sandbox="allow-scripts" src="${PATH}?embed=body"`,
};

const it = {};

/** A host that knows nothing of the page but its files. */
function host() {
  const server = createServer((request, response) => {
    const path = new URL(request.url, "http://host").pathname;
    const name = path.slice(PATH.length) || "index.html";
    const inner = FRAMES[path];
    const frame = inner && `<!doctype html><title>lecture</title><iframe ${inner} width="600" height="500"></iframe>`;
    // Under the second path the host lets pages of any origin read its files.
    const open = path.startsWith(OPEN) ? { "access-control-allow-origin": "*" } : {};
    try {
      const content = frame ?? (path === "/one.html" ? oneFile(SITE) : readFileSync(join(SITE, path.startsWith(PATH) ? name : path.startsWith(OPEN) ? path.slice(OPEN.length) || "index.html" : "none")));
      response.writeHead(200, { "content-type": KINDS[frame ? "html" : path.endsWith("/") ? "html" : path.split(".").at(-1)], ...open }).end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(server)));
}

before(async () => {
  const [server, browser] = await Promise.all([host(), launch()]);
  const file = join(mkdtempSync(join(tmpdir(), "motiform-alone-")), "motiform.html");
  writeFileSync(file, oneFile(SITE));
  Object.assign(it, { server, browser, origin: `http://127.0.0.1:${server.address().port}`, file: pathToFileURL(file).href });
});

after(async () => {
  await it.browser?.close();
  it.server?.close();
});

/** Opens an address in the tab of the visit before, or one with this context of its own; any error in the console fails the test. */
async function visit(address, act, tolerate = null, own = null) {
  const page = (!own && it.tab) || (await newTab(it.browser, { viewport: VIEWPORT, colorScheme: "light", ...own }));
  const faults = [];
  page.on("console", (message) => message.type() === "error" && !/favicon/.test(message.location().url) && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(error.stack ?? String(error)));
  await page.goto(address);
  await act(page);
  if (own) await page.context().close();
  else it.tab = await vacate(page);
  assert.deepEqual(faults.filter((text) => !tolerate?.test(text) && !ofDriver(text)), []);
}

/** Waits until the body moves; gives the milliseconds since the page was opened. */
function moving(frame) {
  return frame.waitForFunction(() => {
    const now = window.motiform?.position();
    const before = (window.before ??= now);
    return now && before && (now[0] !== before[0] || now[1] !== before[1]) ? performance.now() : false;
  }, null, { polling: 20 }).then((handle) => handle.jsonValue());
}

const named = (frame, name) => frame.locator(`#regime[data-regime="${name}"]`).waitFor({ timeout: 4 * PATIENCE });
const complete = (page) => page.waitForFunction(() => window.motiform.map.complete && performance.now(), null, { timeout: 4 * PATIENCE, polling: 20 }).then((handle) => handle.jsonValue());

test("one file from a disk: a body moves, is named, and a map fills", async (t) => {
  await visit(`${it.file}#preset=fig1`, async (page) => {
    t.diagnostic(`moving after ${Math.round(await moving(page))} ms`);
    assert.match(await page.locator("#connection-text").textContent(), /no server/);
    assert.ok(await page.locator("#banner").isHidden());
    t.diagnostic(`map of Fig. 1 complete after ${Math.round(await complete(page))} ms`);
    assert.ok((await page.locator("#map-legend li").count()) > 2);
    await shoot(page, "alone-fig1");
  });
  await visit(`${it.file}#${LIGHT}`, async (page) => {
    await moving(page);
    await named(page, "zigzag");
    // A change is named as well, and what was found before it is not shown any more.
    await page.evaluate(() => (location.hash = "preset=fig5a&kappa2=2&x=kappa2:1.2:1.6&y=kappa3:0.7:1"));
    await named(page, "circular");
    await shoot(page, "alone-fig5a");
  });
});

test("a static host under a sub-path: branches, a swarm and a second place", async () => {
  await visit(`${it.origin}${PATH}#${LIGHT}`, async (page) => {
    await moving(page);
    await page.locator("#swarm-menu summary").click();
    await page.locator("#swarm-begin").click();
    await page.locator("#swarm-note").waitFor();
    await page.locator("#compare").click();
    await page.locator("#twin").waitFor();
    await page.locator("#show-branches").click();
    await page.locator("#branch-follow").click();
    await page.locator("#branch-legend li").first().waitFor({ timeout: 4 * PATIENCE });
    await shoot(page, "alone-branches");
  });
});

test("every file can be saved without a server", async () => {
  await visit(`${it.origin}${PATH}#preset=fig5b&x=kappa2:1.2:1.6&y=kappa3:0.7:1`, async (page) => {
    const judge = await it.browser.newPage();
    await moving(page);
    await page.locator("#speed").focus();
    await page.keyboard.press("End");
    for (const id of ["spectrum-empty", "returns-empty", "exponents-empty"]) await page.locator(`#${id}`).waitFor({ state: "hidden", timeout: 4 * PATIENCE });
    await page.waitForFunction(() => document.getElementById("map-progress-bar").value > 0);
    await page.locator("#play").click();
    await page.locator("#share-menu > summary").click();
    await assertAllFiles(page, judge);
    await judge.close();
  });
});

// What axe judges, the document and its styles, is the same in both browsers: one of the two widths is enough in Firefox.
for (const [name, context, options] of [["a desktop", null, {}], ["a narrow window", { viewport: { width: 390, height: 844 } }, onlyIn("chromium", "a narrow window")]]) {
  test(`axe finds nothing without a server, on ${name}`, options, async () => {
    await visit(`${it.file}#${LIGHT}`, async (page) => {
      await moving(page);
      await page.locator("#regime:not([data-regime=''])").waitFor({ timeout: 4 * PATIENCE });
      await assertAccessible(page);
    }, null, context);
  });
}

test("basins without a server", async () => {
  await visit(`${it.file}#preset=fig4&kappa2=0.12&kappa3=0.45&x=u222:-1.5:1.5&y=none`, async (page) => {
    await moving(page);
    await complete(page);
    const names = await page.locator("#map-legend li").allTextContents();
    for (const name of ["circular", "chaotic"]) assert.ok(names.some((text) => text.includes(name)), `${names}`);
  });
});

test("in a frame of a lecture page", async () => {
  await visit(`${it.origin}/lecture.html`, async (page) => {
    const frame = await (await page.locator("iframe").elementHandle()).contentFrame();
    await moving(frame);
    assert.ok(await frame.locator("#map-panel").isHidden());
  });
});

for (const [what, name] of [["one file", "one"], ["a host that allows it", "open"]]) {
  test(`in a sandboxed frame: ${what}`, async () => {
    await visit(`${it.origin}/sandboxed-${name}.html`, async (page) => {
      const frame = await (await page.locator("iframe").elementHandle()).contentFrame();
      await moving(frame);
      await frame.locator("#regime:not([data-regime=''])").waitFor({ timeout: 4 * PATIENCE });
      await shoot(page, `sandboxed-${name}`);
    });
  });
}

test("in a sandboxed frame of a host that does not allow it, the page says what to do", async () => {
  const refused = /CORS|Access-Control-Allow-Origin|ERR_FAILED|computation failed|helper failed|Cross-Origin/;
  await visit(`${it.origin}/sandboxed-closed.html`, async (page) => {
    const frame = await (await page.locator("iframe").elementHandle()).contentFrame();
    const note = frame.locator("#toasts li").first();
    await note.waitFor();
    assert.match(await note.textContent(), /motiform\.html/);
  }, refused);
});

test("where storage is denied, a body moves and is named", async () => {
  await visit("about:blank", async (page) => {
    await page.addInitScript(denied);
    await page.goto(`${it.origin}${PATH}#${LIGHT}`);
    await moving(page);
    await named(page, "zigzag");
  }, null, {});
});

/** The server dies and comes back: the page says so, and the body goes on from where it was. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { TOKEN, Server } from "./server.mjs";
import { LIGHT, shoot, stage, visit } from "./stage.mjs";
import { changed, moves, named, pictures, seen, slide, slider, stands, until } from "./waits.mjs";

const it = stage();

for (const playing of [true, false]) {
  test(`a ${playing ? "moving" : "paused"} body goes on after the server was killed`, async () => {
    const server = await Server.start();
    const { page, wire, leave } = await visit({ browser: it.browser, server }, { hash: LIGHT, own: true, tolerate: /WebSocket connection|ERR_CONNECTION_(REFUSED|RESET)|connection to .* was interrupted|establish a connection/ });
    await moves(page, wire);
    const { revision } = wire.frame;
    await slide(slider(page, "kappa2"), 0.8);
    await changed(wire, revision);
    if (playing) await moves(page, wire);
    else {
      await page.locator("#play").click();
      await stands(page, wire);
    }
    const { parameters } = wire.last.get("changed");
    await server.stop("SIGKILL");
    await page.locator("#banner").waitFor();
    assert.equal(await page.locator("#banner-command").textContent(), `motiform explore --port ${server.port} --token ${TOKEN}`);
    assert.equal(await page.locator("#connection").getAttribute("data-state"), "closed");
    if (playing) await shoot(page, "server-gone");
    const before = wire.frame;
    wire.last.clear();
    wire.frames.length = 0;
    const again = await Server.start({ port: server.port });
    await page.locator("#connection[data-state=open]").waitFor();
    await page.locator("#banner").waitFor({ state: "hidden" });
    await seen(page, wire);
    assert.ok(!wire.last.has("refused"), JSON.stringify(wire.last.get("refused")));
    assert.deepEqual(wire.last.get("begun").parameters, parameters);
    const [first] = wire.frames;
    const speed = Math.hypot(before.state[0], before.state[1]);
    assert.ok(first.t >= before.t && Math.hypot(first.x - before.x, first.y - before.y) <= 3 * speed * (first.t - before.t) + 1e-9, `${JSON.stringify(before)} then ${JSON.stringify(first)}`);
    if (playing) await moves(page, wire);
    else assert.deepEqual([first.t, first.x, first.y], [before.t, before.x, before.y]);
    if (!playing) first.state.forEach((value, k) => assert.ok(Math.abs(value - before.state[k]) <= 1e-12, "the state"));
    await named(page);
    await until(() => wire.last.has("mapped") || wire.last.has("progress"), "the map");
    await leave();
    await again.stop();
  });
}

test("a page that comes back says nothing before the greeting, however late it comes", async () => {
  const { page, leave } = await visit(it, { hash: "preset=fig2", own: true });
  const [lines, early] = [[], []];
  await page.routeWebSocket(/live$/, (ours) => {
    const server = ours.connectToServer();
    let greeted = false;
    ours.onMessage((message) => {
      if (!greeted) early.push(message);
      server.send(message);
    });
    server.onMessage(async (message) => {
      if (!greeted) await pictures(page, 30);
      greeted = true;
      ours.send(message);
    });
    lines.push(ours);
  });
  await page.reload();
  await page.waitForFunction(() => window.motiform?.position());
  await lines[0].close();
  await until(() => lines.length === 2, "another connection");
  const time = await page.locator("#clock-t").textContent();
  await page.waitForFunction((before) => Number(document.getElementById("clock-t").textContent) > before, Number(time));
  assert.deepEqual(early, []);
  await leave();
});

test("a server that stops answering is no green light, and the body goes on when it answers again", async () => {
  const server = await Server.start();
  const { page, wire, leave } = await visit({ browser: it.browser, server }, { hash: LIGHT, own: true });
  await moves(page, wire);
  server.child.kill("SIGSTOP");
  await page.locator("#connection[data-state=silent]").waitFor();
  await page.locator("#banner").waitFor();
  assert.match(await page.locator("#banner").innerText(), /does not answer/);
  assert.doesNotMatch(await page.locator("#banner").innerText(), /Restart|reconnects|Eight/);
  assert.equal(await page.locator("#connection-text").textContent(), "no answer");
  await shoot(page, "server-silent");
  server.child.kill("SIGCONT");
  await page.locator("#connection[data-state=open]").waitFor();
  await page.locator("#banner").waitFor({ state: "hidden" });
  await moves(page, wire);
  await leave();
  await server.stop();
});

test("why a connection was closed is said", async () => {
  const { page, wire, leave } = await visit(it, { hash: LIGHT, own: true });
  await page.routeWebSocket(/live$/, (ours) => {
    const server = ours.connectToServer();
    let ends = false; // nothing follows the message at which the server closes
    ours.onMessage((message) => {
      if (ends) return;
      ends = message.includes('"kick"');
      server.send(ends ? "x".repeat(40_000) : message);
    });
  });
  await page.reload();
  await page.waitForFunction(() => window.motiform?.position());
  await page.locator("#kick").click();
  await page.locator("#toasts li", { hasText: "The server closed the connection: a message was too long" }).waitFor();
  await page.locator("#connection[data-state=open]").waitFor();
  await leave();
});

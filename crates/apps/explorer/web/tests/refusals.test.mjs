/** Who is not let in, and what nobody gets done: seen from a real browser. The page of somebody else does not notice. */

import assert from "node:assert/strict";
import { once } from "node:events";
import { createServer, request } from "node:http";
import { test } from "node:test";
import { LIGHT, stage, upon } from "./stage.mjs";
import { moves } from "./waits.mjs";

const it = stage();
const WRONG = "f".repeat(32);

/** Opens a socket in this page, says these things and tells what came back. */
function converse(page, address, messages) {
  return page.evaluate(([where, all]) => new Promise((done) => {
    const socket = new WebSocket(where);
    const heard = { opened: false, refused: [], code: null };
    socket.onopen = () => {
      heard.opened = true;
      for (const one of all) socket.send(one);
    };
    socket.onmessage = ({ data }) => {
      const answer = typeof data === "string" ? JSON.parse(data) : {};
      if (answer.is === "refused") heard.refused.push(answer.why);
      if (heard.refused.length === all.length) socket.close();
    };
    socket.onclose = ({ code }) => done({ ...heard, code });
  }), [address, messages]);
}

const live = (server, token = null) => `${(token ? server.address.replace(/[^/]+\/$/, `${token}/`) : server.address).replace("http", "ws")}live`;

/** The status of a request to become a socket. */
async function upgrade(server, path, origin) {
  const headers = { connection: "Upgrade", upgrade: "websocket", "sec-websocket-version": "13", "sec-websocket-key": "dGhlIHNhbXBsZSBub25jZQ==", origin };
  const asked = request({ host: "127.0.0.1", port: server.port, path, headers });
  asked.end();
  const answer = await Promise.race([once(asked, "response"), once(asked, "upgrade")]);
  asked.destroy();
  return answer[0].statusCode;
}

test("a wrong token opens nothing", upon(it, { hash: LIGHT, tolerate: /WebSocket|403|establish a connection/ }, async ({ page, wire, server, browser }) => {
  await moves(page, wire);
  for (const path of [`/${WRONG}/`, `/${WRONG}/app.js`]) assert.equal((await fetch(server.origin + path)).status, 403);
  const other = await browser.newPage();
  const answer = await other.goto(`${server.origin}/${WRONG}/`).then((response) => `${response.status()} ERR_HTTP`, String);
  assert.match(answer, /403 ERR_HTTP|ERR_HTTP_RESPONSE_CODE_FAILURE/);
  await other.close();
  const token = new URL(server.address).pathname;
  assert.equal(await upgrade(server, `/${WRONG}/live`, server.origin), 403);
  assert.equal(await upgrade(server, `${token}live`, server.origin), 101);
  const { opened, code } = await converse(page, live(server, WRONG), []);
  assert.deepEqual([opened, code], [false, 1006]);
  await moves(page, wire);
}));

test("a page from elsewhere that knows the token is refused", upon(it, { hash: LIGHT }, async ({ page, wire, server, browser }) => {
  await moves(page, wire);
  const elsewhere = createServer((_, response) => response.setHeader("content-type", "text/html").end("<!doctype html><title>elsewhere</title>"));
  elsewhere.listen(0, "127.0.0.1");
  await once(elsewhere, "listening");
  const foreign = await browser.newPage();
  await foreign.goto(`http://127.0.0.1:${elsewhere.address().port}/`);
  const { opened } = await converse(foreign, live(server), []);
  assert.equal(opened, false);
  const read = await foreign.evaluate((address) => fetch(address).then(() => "read", () => "kept"), server.address);
  assert.equal(read, "kept");
  await foreign.close();
  elsewhere.close();
  const token = new URL(server.address).pathname;
  for (const origin of ["http://evil.example", "null", `https://127.0.0.1:${server.port}`]) assert.equal(await upgrade(server, `${token}live`, origin), 403, origin);
  await moves(page, wire);
}));

test("malformed messages are refused one by one, a huge one ends its connection alone", upon(it, { hash: LIGHT }, async ({ page, wire, server }) => {
  await moves(page, wire);
  const bad = ["nonsense", "{}", '{"do":"fly"}', '{"do":"set","parameters":{"kappa2":"x"}}', '{"do":"advance","dt":-1}', '{"do":"export","id":1,"what":"/etc/passwd"}'];
  const heard = await converse(page, live(server), bad);
  assert.equal(heard.refused.length, bad.length);
  assert.ok(heard.refused.every((why) => why.length > 10), heard.refused.join("\n"));
  assert.equal((await converse(page, live(server), ["x".repeat(40_000)])).code, 1009);
  await moves(page, wire);
  assert.equal(await page.locator("#toasts li").count(), 0);
}));

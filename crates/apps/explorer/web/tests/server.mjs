/** The server under test: the binary that MOTIFORM names, started as a reader would start it. */

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createInterface } from "node:readline";

/** A secret that the tests know. */
export const TOKEN = "0123456789abcdef0123456789abcdef";

/** The binary under test. */
export function binary() {
  const path = process.env.MOTIFORM;
  assert.ok(path, "name the binary in MOTIFORM, or run `cargo xtask explorer`");
  return path;
}

/** A running `motiform explore`; without a port, on any free one. */
export class Server {
  static async start({ port = null, token = TOKEN, file = null } = {}) {
    const where = port === null ? [] : ["--port", String(port)];
    const child = spawn(binary(), ["explore", ...(file ? [file] : []), "--no-open", "--token", token, ...where], { stdio: ["ignore", "pipe", "inherit"] });
    for await (const line of createInterface({ input: child.stdout })) {
      const address = line.match(/http:\/\/\S+/)?.[0];
      if (address) return new Server(child, address);
    }
    throw new Error(`${binary()} explore ended without an address`);
  }

  constructor(child, address) {
    child.stdout.resume(); // nothing else is said, and a full pipe would stop it
    // A test that fails leaves it behind: that must not keep the test process waiting.
    child.unref();
    child.stdout.unref();
    process.once("exit", () => child.kill("SIGKILL"));
    this.child = child;
    this.address = address;
    this.origin = new URL(address).origin;
    this.port = Number(new URL(address).port);
  }

  get pid() {
    return this.child.pid;
  }

  get running() {
    return this.child.exitCode === null && this.child.signalCode === null;
  }

  /** Ends it; resolves once it is gone. */
  async stop(signal = "SIGKILL") {
    if (!this.running) return;
    const gone = once(this.child, "exit");
    this.child.kill(signal);
    await gone;
  }
}

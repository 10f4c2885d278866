/**
 * A page that nobody watches while it is measured: a tool that listens to the network of a page pays for every message, and makes the
 * page pay, too. The tool is connected before and after, to ask for what the page knows.
 */

import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { executable, FLAGS } from "../tests/stage.mjs";
import { processSeconds } from "./cost.mjs";

const wait = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));

export class Unwatched {
  static async open(address) {
    const page = new Unwatched();
    page.profile = mkdtempSync(join(tmpdir(), "motiform-measure-"));
    const options = ["--headless=new", "--window-size=1280,807", "--remote-debugging-port=0", `--user-data-dir=${page.profile}`];
    page.process = spawn(executable(), [...FLAGS, ...options, address], { stdio: "ignore", detached: true });
    const port = join(page.profile, "DevToolsActivePort");
    while (!existsSync(port) || !readFileSync(port, "utf8").includes("\n")) await wait(0.1);
    page.port = readFileSync(port, "utf8").split("\n")[0];
    return page;
  }

  /** Asks the page, then leaves it alone again. */
  async ask(question) {
    const browser = await chromium.connectOverCDP(`http://127.0.0.1:${this.port}`);
    const found = browser.contexts()[0].pages().find((one) => one.url().startsWith("http"));
    found.setDefaultTimeout(600_000);
    const answer = await question(found);
    await browser.close();
    return answer;
  }

  /** Waits until the motion has its name and its exponents, and the map all its cells. */
  settled() {
    return this.ask((page) => page.waitForFunction(() => {
      const exponents = document.getElementById("exponent-values").textContent;
      return document.getElementById("regime").dataset.regime && window.motiform.map.complete && exponents && !exponents.endsWith("\u2026");
    }));
  }

  /** Pictures per second, and the shares of a core that the parts take, over so many seconds. */
  async shares(server, seconds) {
    const frames = () => this.ask((page) => page.evaluate(() => [window.motiform.frames, performance.now() / 1000]));
    const [first, begin] = await frames();
    await wait(1);
    const before = this.used(server);
    await wait(seconds);
    const after = this.used(server);
    const [last, end] = await frames();
    const share = (key) => (after[key] - before[key]) / (after.now - before.now);
    return { rate: (last - first) / (end - begin), own: share("own"), main: share("main"), renderer: share("renderer"), all: share("all") };
  }

  /** Drags a slider about its value for so many seconds; frames and changes per second. */
  async dragged(name, seconds) {
    await this.ask((page) => page.waitForFunction((of) => document.querySelector(`[data-parameter="${of}"]`) && document.getElementById("regime").dataset.regime, name));
    await this.ask((page) => page.evaluate(([of, length]) => {
      const slider = document.querySelector(`[data-parameter="${of}"] input[type=range]`);
      const [middle, reach] = [slider.valueAsNumber, 0.1 * (slider.max - slider.min)];
      const [begin, first] = [performance.now(), window.motiform.frames];
      let [changes, last] = [0, null];
      const next = (now) => {
        slider.value = String(middle + reach * Math.sin((now - begin) / 500));
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        const { revision } = window.motiform;
        if (revision !== last) changes++;
        last = revision;
        const passed = (now - begin) / 1000;
        if (passed < length) requestAnimationFrame(next);
        else window.dragged = { frames: (window.motiform.frames - first) / passed, changes: changes / passed };
      };
      window.setTimeout(() => requestAnimationFrame(next), 1000);
    }, [name, seconds]));
    await wait(seconds + 2);
    return this.ask((page) => page.waitForFunction(() => window.dragged).then((one) => one.jsonValue()));
  }

  /** CPU seconds so far: of the server, of the busiest renderer and its main thread, of all processes of the browser. */
  used(server) {
    const all = this.processes();
    const renderers = all.filter(({ command }) => command.includes("--type=renderer")).sort((a, b) => b.seconds - a.seconds);
    const [page] = renderers;
    return {
      now: performance.now() / 1000,
      own: processSeconds(server),
      main: processSeconds(page.pid, page.pid),
      renderer: page.seconds,
      all: all.reduce((sum, one) => sum + one.seconds, 0),
    };
  }

  processes() {
    const of = (pid) => {
      try {
        return { pid, command: readFileSync(`/proc/${pid}/cmdline`, "utf8"), seconds: processSeconds(pid) };
      } catch {
        return null; // it has ended
      }
    };
    const mine = (one) => one && (one.command.includes(this.profile) || one.pid === this.process.pid);
    return readdirSync("/proc").filter((name) => /^\d+$/.test(name)).map((name) => of(Number(name))).filter(mine);
  }

  async close() {
    process.kill(-this.process.pid);
    await new Promise((resolve) => this.process.once("exit", resolve));
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}

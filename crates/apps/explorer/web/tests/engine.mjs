/** The module that `cargo xtask web` built, run in Node as a worker of the page runs it: `src/alone/engine.ts` does the same. */

import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { moduleOf } from "../site.mjs";

/** The page without a server. */
export const SITE = join(dirname(fileURLToPath(import.meta.url)), "../../../../../docs/site");

const code = new WebAssembly.Module(moduleOf(SITE));

/** One instance: `notes` has everything that it said since they were taken. */
class Instance {
  notes = [];
  /** Called with each part of an errand's result, as it comes. */
  onBack = () => {};

  constructor() {
    const read = (start, length) => new Uint8Array(this.exports.memory.buffer, start, length);
    const text = (start, length) => new TextDecoder().decode(read(start, length));
    const say = (is) => (start, length) => this.notes.push({ is, text: text(start, length) });
    const back = (start, length) => this.onBack(text(start, length));
    const binary = (start, length) => this.notes.push({ is: "binary", bytes: read(start, length).slice().buffer });
    const fault = (start, length) => {
      throw new Error(text(start, length));
    };
    const worker = { now: () => performance.now(), text: say("text"), post: say("post"), back, fault, binary };
    this.exports = new WebAssembly.Instance(code, { worker }).exports;
  }

  call(name, text) {
    const bytes = new TextEncoder().encode(text);
    const start = this.exports.buffer(bytes.length);
    new Uint8Array(this.exports.memory.buffer, start, bytes.length).set(bytes);
    this.exports[name](bytes.length);
    return this.take();
  }

  take() {
    const notes = this.notes;
    this.notes = [];
    return notes;
  }
}

/** A session, and one helper that does all its errands when it is asked to. */
export class Engine {
  #session = new Instance();
  #helper = new Instance();
  #errands = [];
  answers = [];
  binaries = [];

  constructor(mappers = 1) {
    this.#session.exports.begin(mappers);
    this.#sort(this.#session.take());
  }

  /** The module asks its host for nothing but these. */
  static imports() {
    return WebAssembly.Module.imports(code).map(({ module, name }) => `${module}.${name}`);
  }

  say(wish) {
    this.#sort(this.#session.call("hear", JSON.stringify(wish)));
  }

  /** Does errands until an answer of this type is there; gives it. */
  next(is) {
    for (;;) {
      const answer = this.#answered(is);
      if (answer) return answer;
      const errand = this.#errands.shift();
      if (!errand) throw new Error(`no ${is}`);
      const [to, order] = errand.split("\n", 2);
      if (!errand.endsWith("\n")) {
        const parts = [];
        this.#helper.onBack = (part) => parts.push(part);
        this.#helper.call("assist", errand);
        for (const part of parts) this.#sort(this.#session.call("report", part));
      }
      this.#sort(this.#session.call("report", `${to}\n${order}\n`));
    }
  }

  /** As `next`, but what the errand would do after the answer is left undone, as where a worker is ended. Nothing can be asked afterwards. */
  first(is) {
    const ended = {};
    for (const errand of this.#errands.splice(0)) {
      let answer;
      this.#helper.onBack = (part) => {
        this.#sort(this.#session.call("report", part));
        answer = this.#answered(is);
        if (answer) throw ended;
      };
      try {
        this.#helper.call("assist", errand);
      } catch (error) {
        if (error !== ended) throw error;
        return answer;
      }
    }
    throw new Error(`no ${is}`);
  }

  #answered(is) {
    const at = this.answers.findIndex((answer) => answer.is === is);
    return at >= 0 ? this.answers.splice(0, at + 1).at(-1) : undefined;
  }

  #sort(notes) {
    for (const { is, text, bytes } of notes) {
      if (is === "text") this.answers.push(JSON.parse(text));
      else if (is === "post") this.#errands.push(text);
      else if (is === "binary") this.binaries.push(bytes);
    }
  }
}

/** The rows of a frame. */
export function rows(bytes) {
  const view = new DataView(bytes);
  if (view.getUint8(0) !== 1) return [];
  const [samples, columns, coordinates] = [view.getUint16(2, true), view.getUint16(4, true), view.getUint32(12, true)];
  const first = 16 + 8 * (4 + coordinates);
  return Array.from({ length: samples }, (_, row) => Array.from({ length: columns }, (_, column) => view.getFloat64(first + 8 * (row * columns + column), true)));
}

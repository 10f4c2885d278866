/** The module that `cargo xtask web` built, run in Node as a worker of the page runs it: `src/alone/engine.ts` does the same. */

import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { moduleOf } from "../site.mjs";

/** The page without a server. */
export const SITE = join(dirname(fileURLToPath(import.meta.url)), "../../../../docs/site");

const code = new WebAssembly.Module(moduleOf(SITE));

/** One instance: `notes` has everything that it said since they were taken. */
class Instance {
  notes = [];

  constructor() {
    const read = (start, length) => new Uint8Array(this.exports.memory.buffer, start, length);
    const say = (is) => (start, length) => this.notes.push({ is, text: new TextDecoder().decode(read(start, length)) });
    const binary = (start, length) => this.notes.push({ is: "binary", bytes: read(start, length).slice().buffer });
    const fault = (start, length) => {
      throw new Error(new TextDecoder().decode(read(start, length)));
    };
    const worker = { now: () => performance.now(), text: say("text"), post: say("post"), back: say("back"), fault, binary };
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
      const at = this.answers.findIndex((answer) => answer.is === is);
      if (at >= 0) return this.answers.splice(0, at + 1).at(-1);
      const errand = this.#errands.shift();
      if (!errand) throw new Error(`no ${is}`);
      const [to, order] = errand.split("\n", 2);
      if (!errand.endsWith("\n")) {
        for (const { is: kind, text } of this.#helper.call("assist", errand)) if (kind === "back") this.#sort(this.#session.call("report", text));
      }
      this.#sort(this.#session.call("report", `${to}\n${order}\n`));
    }
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

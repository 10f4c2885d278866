/** A worker: the module, its memory, and the functions that it needs; `crates/apps/explorer/src/module/boundary.rs` is the other side. */

import type { Note, Order } from "./orders";

interface Module {
  memory: WebAssembly.Memory;
  buffer(length: number): number;
  begin(mappers: number): void;
  hear(length: number): void;
  report(length: number): void;
  assist(length: number): void;
}

const encoder = new TextEncoder();
const decoder = new TextDecoder();
const note = (one: Note, transfer: Transferable[] = []): void => self.postMessage(one, { transfer });

let module: Module | null = null;

function load(code: WebAssembly.Module): Module {
  const read = (start: number, length: number): Uint8Array => new Uint8Array(instance.exports.memory.buffer, start, length);
  const say = (is: "text" | "post" | "back" | "fault") => (start: number, length: number) => note({ is, text: decoder.decode(read(start, length)) });
  const binary = (start: number, length: number): void => {
    const bytes = read(start, length).slice().buffer;
    note({ is: "binary", bytes }, [bytes]);
  };
  const worker = { now: () => performance.now(), text: say("text"), post: say("post"), back: say("back"), fault: say("fault"), binary };
  const instance = new WebAssembly.Instance(code, { worker }) as { exports: unknown } as { exports: Module };
  return instance.exports;
}

/** Writes a text where the module reads it; gives its length. */
function write(to: Module, text: string): number {
  const bytes = encoder.encode(text);
  const start = to.buffer(bytes.length);
  new Uint8Array(to.memory.buffer, start, bytes.length).set(bytes);
  return bytes.length;
}

/** What came before the module. */
const early: Order[] = [];

function obey(order: Order): void {
  if (order.do === "load") {
    module = load(order.module);
    early.splice(0).forEach(obey);
    return;
  }
  if (!module) {
    early.push(order);
    return;
  }
  if (order.do === "begin") module.begin(order.mappers);
  else module[order.do](write(module, order.text));
  if (order.do === "assist") note({ is: "done" });
}

self.onmessage = ({ data }: MessageEvent<Order>) => obey(data);

/** The helpers of a session: workers that do its errands, one after the other. What is stale and takes long is ended with its worker. */

import Engine from "./engine?worker&inline";
import { code } from "./module";
import type { Note, Order } from "./orders";

/** A stale job may go on for so long (milliseconds): most are done sooner than a new worker is there. */
const GRACE = 150;

/** A worker with the module: it starts while that is compiled. */
export function engine(hear: (note: Note) => void): Worker {
  const worker = new Engine();
  worker.onmessage = ({ data }: MessageEvent<Note>) => hear(data);
  worker.onerror = ({ message }) => hear({ is: "fault", text: message });
  const failed = (error: unknown): void => hear({ is: "fault", text: String(error) });
  code().then((module) => worker.postMessage({ do: "load", module } satisfies Order), failed);
  return worker;
}

class Helper {
  private worker: Worker;
  /** The errand under way, and the one that waits. */
  private busy: string | null = null;
  private next: string | null = null;
  private timer = 0;
  private over = false;

  constructor(private readonly report: (text: string) => void) {
    this.worker = this.start();
  }

  /** Does an errand, instead of the one before; without a job: what is done is stale. */
  take(errand: string): void {
    this.next = errand.endsWith("\n") ? null : errand;
    if (this.busy === null) this.go();
    else if (!this.timer) this.timer = window.setTimeout(() => this.cut(), GRACE);
  }

  end(): void {
    this.over = true;
    window.clearTimeout(this.timer);
    this.worker.terminate();
  }

  private start(): Worker {
    return engine((note) => {
      if (note.is === "back") this.report(note.text);
      else if (note.is === "done") this.done();
      else if (note.is === "fault") this.fail(note.text);
    });
  }

  private go(): void {
    window.clearTimeout(this.timer);
    this.timer = 0;
    this.busy = this.next;
    this.next = null;
    if (this.busy !== null) this.worker.postMessage({ do: "assist", text: this.busy } satisfies Order);
  }

  private done(): void {
    const [to, order] = (this.busy ?? "").split("\n", 2);
    this.busy = null;
    this.go();
    this.report(`${to}\n${order}\n`);
  }

  /** The job is stale and takes long. */
  private cut(): void {
    this.worker.terminate();
    this.worker = this.start();
    this.go();
  }

  private fail(why: string): void {
    if (this.over) return;
    console.error(`a helper failed: ${why}`);
    this.worker.terminate();
    this.worker = this.start();
    this.done();
  }
}

export class Helpers {
  private readonly all = new Map<string, Helper>();

  constructor(private readonly report: (text: string) => void) {}

  /** Brings an errand to its helper. */
  take(errand: string): void {
    const name = errand.slice(0, errand.indexOf("\n"));
    this.helper(name).take(errand);
  }

  /** The helper of this name, and its worker. */
  helper(name: string): Helper {
    const found = this.all.get(name) ?? new Helper(this.report);
    this.all.set(name, found);
    return found;
  }

  end(): void {
    this.all.forEach((helper) => helper.end());
    this.all.clear();
  }
}

/** The menu of the swarm: how many bodies, from where; and what they end in. */

import { Swarm } from "./body/swarm";
import type { SwarmFrame } from "./binary";
import { byId, make, setText } from "./dom";
import { swatch } from "./glyphs";
import { pretty } from "./numbers";
import type { Member, Regime, SwarmStart, Wish } from "./protocol";

/** The distances at which bodies begin near the body: powers of ten from one to the other. */
const SPREAD = { least: -9, most: -1 };
/** Bodies by default: of a swarm, and of those that begin near the body. */
const USUAL: Record<SwarmStart, number> = { starts: 60, near: 1, noises: 30 };
/** The note is renewed after so many milliseconds. */
const GAP = 200;

/** What the swarm needs of the page. */
export interface SwarmHost {
  send(wish: Wish): void;
  regimes(): Regime[];
  /** Something is to be drawn. */
  changed(): void;
  noise(): number;
}

export class SwarmPanel {
  readonly view = new Swarm();
  private readonly bodies = byId<HTMLInputElement>("swarm-bodies");
  private readonly from = byId<HTMLSelectElement>("swarm-from");
  private readonly spread = byId<HTMLInputElement>("swarm-spread");
  private first = NaN;
  private told = -Infinity;

  constructor(private readonly host: SwarmHost) {
    this.from.addEventListener("change", () => this.choose());
    for (const one of [this.bodies, this.spread]) one.addEventListener("input", () => this.show());
    byId("swarm-begin").addEventListener("click", () => this.begin());
    byId("swarm-end").addEventListener("click", () => this.end());
    this.choose();
  }

  private get start(): SwarmStart {
    return this.from.value as SwarmStart;
  }

  private choose(): void {
    this.bodies.value = String(USUAL[this.start]);
    this.show();
  }

  private show(): void {
    setText(byId("swarm-bodies-value"), this.bodies.value);
    setText(byId("swarm-spread-value"), pretty(this.apart(), 2));
    byId("swarm-spread-row").hidden = this.start !== "near";
  }

  private apart(): number {
    return Number((10 ** (SPREAD.least + (SPREAD.most - SPREAD.least) * (this.spread.valueAsNumber / 100))).toPrecision(2));
  }

  private begin(): void {
    this.view.begin(this.start === "starts");
    this.first = NaN;
    this.host.send({ do: "swarm", bodies: this.bodies.valueAsNumber, from: this.start, spread: this.apart() });
    byId<HTMLDetailsElement>("swarm-menu").open = false;
    byId("swarm-end").hidden = false;
  }

  private end(): void {
    this.host.send({ do: "swarm", bodies: 0, from: "starts", spread: 0 });
    this.clear();
  }

  /** Another body: it has no swarm. */
  clear(): void {
    this.view.clear();
    byId("swarm-note").hidden = true;
    byId("swarm-end").hidden = true;
    this.host.changed();
  }

  /** The motion is another one. */
  renew(): void {
    this.view.renew();
    this.tell();
  }

  take(frame: SwarmFrame): void {
    if (byId("swarm-end").hidden) return; // of a swarm that was ended
    this.view.take(frame);
    if (!(this.first > 0)) this.first = this.view.distance;
    this.host.changed();
    if (performance.now() - this.told > GAP) this.tell();
  }

  member({ body, regime }: Member): void {
    this.view.name(body, this.host.regimes().find((one) => one.name === regime) ?? null);
    this.host.changed();
    this.tell();
  }

  /** What the swarm does, in words. */
  private tell(): void {
    this.told = performance.now();
    const note = byId("swarm-note");
    note.hidden = this.view.count === 0;
    if (note.hidden) return;
    if (this.view.named) {
      const shares = this.view.shares();
      const left = this.view.count - shares.reduce((sum, [, count]) => sum + count, 0);
      const parts = shares.map(([regime, count]) => make("span", {}, swatch(regime, 13), `${count} ${regime.words}`));
      return note.replaceChildren(...parts, ...(left ? [make("span", {}, `${left} not classified yet`)] : []));
    }
    if (this.start === "noises" && this.host.noise() === 0) return note.replaceChildren("without noise all bodies are the same: raise the noise");
    const ratio = this.view.distance / this.first;
    const grown = this.first > 0 ? `, ${pretty(ratio, 2)} times that of the beginning` : "";
    note.replaceChildren(`distance of the ${this.view.count === 1 ? "shapes" : "first shape"}: ${pretty(this.view.distance, 2)}${grown}`);
  }
}

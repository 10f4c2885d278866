/** The row of linked strips: asks for what the server computes, draws at most eight times a second. */

import type { BodyPanel } from "../body/panel";
import type { History } from "../history";
import type { Exponents, Observable, ReturnsAhead, Section, Strips, Wish } from "../protocol";
import { byId } from "../dom";
import { ExponentStrip } from "./exponents";
import { recolourKeys } from "./keys";
import { ReturnStrip } from "./returns";
import { SeriesStrip } from "./series";
import { SpectrumStrip } from "./spectrum";

/** So many returns are computed at once. */
const RETURNS = 300;
const ASK_GAP = 500;
const DRAW_GAP = 125;

export class StripPanels {
  private readonly series: SeriesStrip;
  private readonly spectrum = new SpectrumStrip();
  private readonly returns: ReturnStrip;
  private readonly exponent = new ExponentStrip();
  private asked = 0;
  private waiting = false;
  private drawn = 0;
  private shown = NaN;
  private due = true;

  constructor(
    private readonly history: History,
    private readonly send: (wish: Wish) => void,
    pointed: (time: number | null) => void,
    changed: (before: { section: Section; y: number | null }) => void,
  ) {
    this.series = new SeriesStrip(history, pointed);
    this.returns = new ReturnStrip((before) => {
      this.due = true;
      changed(before);
    });
    byId("returns-ahead").addEventListener("click", () => {
      this.returns.waits(true);
      this.send({ do: "returns", ...this.section(), count: RETURNS });
    });
  }

  /** Returns computed ahead. */
  returned(ahead: ReturnsAhead): void {
    if (ahead.returns.section === this.section().section) this.returns.take(ahead);
  }

  begin(observables: Observable[], section: Section, y: number | null): void {
    this.series.begin(observables);
    this.returns.setSection(section, y);
    this.shown = NaN;
  }

  /** This section of the return map. */
  choose(section: Section, y: number | null): void {
    const now = this.section();
    if (now.section === section && now.y === y) return;
    this.returns.setSection(section, y);
    this.returns.clear();
    this.due = true;
  }

  /** The motion changed: what was computed about it holds no longer. */
  renew(): void {
    this.exponent.clear();
    this.returns.renew();
    this.waiting = false;
    this.due = true;
  }

  section(): { section: Section; y: number | null } {
    return this.returns.section();
  }

  exponents(exponents: Exponents): void {
    this.exponent.take(exponents);
  }

  take(strips: Strips, current: boolean): void {
    this.waiting = false;
    if (!current) return;
    this.spectrum.show(strips);
    if (strips.returns.section === this.section().section) this.returns.show(strips.returns);
  }

  touch(): void {
    recolourKeys();
    this.returns.touch();
  }

  draw(now: number, moving: boolean, body: BodyPanel): void {
    if ((moving || this.due) && !this.waiting && now - this.asked > ASK_GAP && body.last()) this.ask(now);
    if (now - this.drawn < DRAW_GAP) return;
    this.drawn = now;
    const mark = body.now() + 1e-3 * this.history.length + body.since();
    if (mark !== this.shown) this.series.show(body.since(), body.now(), body.last()?.radius ?? 1);
    this.shown = mark;
    this.returns.draw();
    this.exponent.draw();
  }

  private ask(now: number): void {
    this.asked = now;
    this.waiting = true;
    this.due = false;
    this.send({ do: "strips", ...this.section() });
  }
}

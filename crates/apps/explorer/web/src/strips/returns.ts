/** The return map: each value against the one before, on equal axes, with the diagonal. */

import { Sheet } from "../canvas";
import { byId, setText } from "../dom";
import { readNumber } from "../fields";
import { toast } from "../toasts";
import { given, pretty } from "../numbers";
import { drawAxes, leftRoom, pixelX, pixelY, type Box, type View } from "../plot";
import type { Returns, ReturnsAhead, Section } from "../protocol";
import { currentInks, curve } from "../theme";
import { behind, ofSpeed, units } from "../units";

/** Width of the button beside the name of the lower axis. */
const BUTTON = 32;

export class ReturnStrip {
  private readonly sheet: Sheet;
  private returns: Returns | null = null;
  /** Returns that were computed ahead: of the present motion and section. */
  private ahead: Returns | null = null;
  private dirty = true;
  private readonly select = byId<HTMLSelectElement>("section");
  private readonly line = byId<HTMLInputElement>("section-y");

  /** What was chosen before. */
  private before: { section: Section; y: number | null } = { section: "speed", y: null };

  /** `chosen` hears of another section, and which one was before. */
  constructor(chosen: (before: { section: Section; y: number | null }) => void) {
    this.sheet = new Sheet(byId<HTMLCanvasElement>("returns"), () => (this.dirty = true));
    const changed = (): void => {
      const read = readNumber(this.line.value);
      if ("why" in read && this.line.value.trim() !== "") toast(`Height of the line: ${read.why}`);
      byId("section-line").hidden = this.select.value !== "path";
      this.clear();
      const { before } = this;
      this.before = this.section();
      chosen(before);
    };
    this.select.addEventListener("change", changed);
    this.line.addEventListener("change", changed);
  }

  section(): { section: Section; y: number | null } {
    const path = this.select.value === "path";
    const read = readNumber(this.line.value);
    return { section: path ? "path" : "speed", y: path && "value" in read ? read.value : null };
  }

  setSection(section: Section, y: number | null): void {
    this.select.value = section;
    this.line.value = y === null ? "" : given(y);
    byId("section-line").hidden = section !== "path";
    this.before = { section, y };
  }

  clear(): void {
    this.returns = null;
    this.renew();
  }

  /** Another motion: what was computed ahead is of the one before. */
  renew(): void {
    this.ahead = null;
    this.waits(false);
    this.dirty = true;
  }

  /** Whether returns ahead are being computed. */
  waits(waiting: boolean): void {
    const button = byId<HTMLButtonElement>("returns-ahead");
    button.disabled = waiting;
    setText(button, waiting ? "\u2026" : "300");
  }

  /** Takes the returns ahead. */
  take({ returns, time, complete }: ReturnsAhead): void {
    this.waits(false);
    if (!complete) toast(returns.points.length ? `The motion gives only ${returns.points.length} returns up to t = ${pretty(time)}${behind(units().time)}.` : "This motion gives no returns.");
    this.ahead = returns.points.length ? returns : null;
    this.dirty = true;
  }

  /** What there is most of. */
  private shown(): Returns | null {
    const [live, ahead] = [this.returns, this.ahead];
    return ahead && ahead.points.length > (live?.points.length ?? 0) ? ahead : live;
  }

  show(returns: Returns): void {
    this.returns = returns;
    this.dirty = true;
  }

  touch(): void {
    this.dirty = true;
  }

  draw(): void {
    if (!this.dirty || this.sheet.width < 80) return;
    this.dirty = false;
    this.sheet.clear();
    const shown = this.shown();
    const points = shown?.points ?? [];
    byId("returns-empty").hidden = points.length > 0;
    byId("returns").dataset.points = String(points.length);
    if (shown && points.length) this.paint(shown);
  }

  private paint({ points, label, section }: Returns): void {
    const { g, width, height } = this.sheet;
    const view = square(points);
    const room = leftRoom(g, { height: height - 46 }, view);
    const size = Math.min(width - room - 10, height - 8 - 38);
    const box: Box = { left: room + (width - room - 10 - size) / 2, top: 8, width: size, height: size };
    const inks = currentInks();
    g.save();
    g.beginPath();
    g.rect(box.left, box.top, box.width, box.height);
    g.clip();
    g.strokeStyle = inks.muted;
    g.setLineDash([4, 4]);
    g.beginPath();
    g.moveTo(box.left, box.top + size);
    g.lineTo(box.left + size, box.top);
    g.stroke();
    g.setLineDash([]);
    g.fillStyle = curve(0);
    g.globalAlpha = points.length > 300 ? 0.6 : 0.9;
    const radius = points.length > 300 ? 1.3 : 2;
    for (const [a, b] of points) {
      g.beginPath();
      g.arc(pixelX(box, view, a), pixelY(box, view, b), radius, 0, 2 * Math.PI);
      g.fill();
    }
    g.restore();
    const unit = section === "speed" ? ofSpeed(units()) : units().length;
    drawAxes(g, box, view, { x: { name: `${label} (*n*)`, unit, taken: BUTTON }, y: { name: `${label} (*n*+1)`, unit } }, inks);
  }
}

/** A square that holds all points; one value alone gets some room. */
function square(points: [number, number][]): View {
  let [low, high] = [Infinity, -Infinity];
  for (const [a, b] of points) {
    low = Math.min(low, a, b);
    high = Math.max(high, a, b);
  }
  const room = Math.max(0.06 * (high - low), 1e-3 * Math.max(Math.abs(low), Math.abs(high))) || 1;
  return { x0: low - room, x1: high + room, y0: low - room, y1: high + room };
}

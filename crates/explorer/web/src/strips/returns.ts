/** The return map: each value against the one before, on equal axes, with the diagonal. */

import { Sheet } from "../canvas";
import { byId } from "../dom";
import { drawAxes, pixelX, pixelY, type Box, type View } from "../plot";
import type { Returns, Section } from "../protocol";
import { currentInks, curve } from "../theme";

export class ReturnStrip {
  private readonly sheet: Sheet;
  private returns: Returns | null = null;
  private dirty = true;
  private readonly select = byId<HTMLSelectElement>("section");
  private readonly line = byId<HTMLInputElement>("section-y");

  /** `chosen` hears of another section. */
  constructor(chosen: () => void) {
    this.sheet = new Sheet(byId<HTMLCanvasElement>("returns"), () => (this.dirty = true));
    const changed = (): void => {
      byId("section-line").hidden = this.select.value !== "path";
      this.clear();
      chosen();
    };
    this.select.addEventListener("change", changed);
    this.line.addEventListener("change", changed);
  }

  section(): { section: Section; y: number | null } {
    const path = this.select.value === "path";
    const y = Number.parseFloat(this.line.value);
    return { section: path ? "path" : "speed", y: path && Number.isFinite(y) ? y : null };
  }

  setSection(section: Section, y: number | null): void {
    this.select.value = section;
    this.line.value = y === null ? "" : String(y);
    byId("section-line").hidden = section !== "path";
  }

  clear(): void {
    this.returns = null;
    this.dirty = true;
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
    const points = this.returns?.points ?? [];
    byId("returns-empty").hidden = points.length > 0;
    if (this.returns && points.length) this.paint(this.returns);
  }

  private paint({ points, label }: Returns): void {
    const { g, width, height } = this.sheet;
    const size = Math.min(width - 62 - 10, height - 8 - 38);
    const box: Box = { left: 62 + (width - 72 - size) / 2, top: 8, width: size, height: size };
    const view = square(points);
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
    drawAxes(g, box, view, { x: `${label} (*n*)`, y: `${label} (*n*+1)` }, inks);
  }
}

/** A square that holds all points; one value alone gets some room. */
function square(points: [number, number][]): View {
  let [low, high] = [Infinity, -Infinity];
  for (const [a, b] of points) {
    low = Math.min(low, a, b);
    high = Math.max(high, a, b);
  }
  const room = Math.max(0.06 * (high - low), 1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-9);
  return { x0: low - room, x1: high + room, y0: low - room, y1: high + room };
}

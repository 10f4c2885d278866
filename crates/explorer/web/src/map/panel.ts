/** The map: asks the server for the window in sight, shows it, and takes the body to where one clicks. */

import { Sheet } from "../canvas";
import type { Cells } from "../binary";
import { byId, setText, throttle } from "../dom";
import { decimalsOf, duration, pretty, roundStep } from "../numbers";
import { watch } from "../pointer";
import { dataX, dataY, pixelX, pixelY, type Box, type View } from "../plot";
import type { Evidence, Mapped, MapStart, Model, Parameter, Plane, Progress, Regime, Values, Wish } from "../protocol";
import { currentInks } from "../theme";
import { AxisSelectors } from "./selectors";
import { landmarks, type Landmark } from "./landmarks";
import { Lattice } from "./lattice";
import { Legend } from "./legend";
import { paint, paintCells, type Memory, type Scene } from "./painting";
import { allowed, panned, sameAxes, viewOf, zoomed } from "./plane";
import { Readout } from "./readout";

/** What the map needs of the page. */
export interface MapHost {
  send(wish: Wish): void;
  regimes(): Regime[];
  model(): Model;
  parameters(): Values;
  /** Takes the body to these parameters. */
  choose(values: Values): void;
  /** The window or the axes changed. */
  moved(): void;
}

/** The page asks for at most eight maps a second. */
const GAP = 125;
/** Pixels per cell, about. */
const CELL = 6;

export class MapPanel {
  private readonly sheet: Sheet;
  private readonly readout: Readout;
  private readonly legend = new Legend(byId("map-legend"));
  private readonly selectors: AxisSelectors;
  private readonly request: () => void;
  private plane: Plane | null = null;
  private home: Plane | null = null;
  private epoch = 0;
  private lattice: Lattice | null = null;
  private memory: Memory | null = null;
  private marks: Landmark[] = [];
  private outdated = false;
  private dirty = false;
  private beforeClick: Values = {};
  complete = false;

  constructor(private readonly host: MapHost) {
    const canvas = byId<HTMLCanvasElement>("map");
    this.sheet = new Sheet(canvas, () => (this.dirty = true));
    this.request = throttle(GAP, () => this.ask());
    this.readout = new Readout(byId("readout"), () => host.regimes(), (cell) => host.send({ do: "evidence", epoch: this.epoch, cell }));
    this.selectors = new AxisSelectors((plane) => this.choosePlane(plane));
    watch(canvas, {
      click: (x, y) => this.click(x, y),
      double: () => this.undoClicks(),
      hover: (at) => (at ? this.hover(...at) : this.readout.leave()),
      pan: (dx, dy) => this.plane && this.go(panned(this.plane, this.box(), dx, dy)),
      zoom: (factor, x, y) => this.zoomAt(factor, x, y),
    });
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("blur", () => this.readout.leave());
    byId("map-reset").addEventListener("click", () => this.reset());
  }

  /** A new body: these axes, and `home` to come back to. */
  begin(plane: Plane, home: Plane): void {
    if (this.plane && !sameAxes(plane, this.plane)) this.memory = this.lattice = null;
    this.home = home;
    this.setPlane(plane);
    this.renew();
  }

  /** Parameters off the axes changed: what is shown holds no longer. */
  renew(): void {
    this.outdated = true;
    this.request();
  }

  /** Draws again before the next picture on the screen. */
  touch(): void {
    this.dirty = true;
  }

  /** The plane as it is, for the address and the server. */
  current(): Plane | null {
    return this.plane;
  }

  /** Whether the parameter is an axis. */
  isAxis(name: string): boolean {
    return this.plane?.x.name === name || this.plane?.y?.name === name;
  }

  window(): View | null {
    return this.plane && viewOf(this.plane);
  }

  /** Where a point of the plane is on the canvas, in CSS pixels. */
  toPixel(x: number, y: number): [number, number] {
    const [box, view] = [this.box(), this.window()];
    return view ? [pixelX(box, view, x), pixelY(box, view, y)] : [0, 0];
  }

  started(start: MapStart): void {
    if (start.epoch !== this.epoch) return;
    this.remember();
    this.lattice = new Lattice(start, this.host.regimes());
    this.marks = [];
    this.complete = false;
    this.outdated = false;
    this.dirty = true;
  }

  cells(cells: Cells): void {
    if (cells.epoch !== this.epoch || !this.lattice) return;
    this.lattice.take(cells);
    this.dirty = true;
  }

  progress({ epoch, done, total, rate }: Progress): void {
    if (epoch !== this.epoch) return;
    const left = rate > 0 ? `, ${duration((total - done) / rate)} left` : "";
    this.say(`${grouped(done)} of ${grouped(total)} cells, ${pretty(rate, 2)}/s${left}`, done / total);
    this.showLegend();
  }

  mapped({ epoch, cells, seconds }: Mapped): void {
    if (epoch !== this.epoch || !this.lattice) return;
    this.complete = true;
    this.memory = null;
    this.marks = landmarks(this.lattice);
    this.say(`${grouped(cells)} cells in ${pretty(seconds, 2)} s`, 1);
    this.showLegend();
    this.readout.refresh();
    this.dirty = true;
  }

  evidence(evidence: Evidence): void {
    if (evidence.epoch === this.epoch) this.readout.answer(evidence);
  }

  /** Draws where something changed. */
  draw(): void {
    const view = this.window();
    if (!this.dirty || !view || !this.plane || this.sheet.width < 80) return;
    this.dirty = false;
    this.sheet.clear();
    paint(this.sheet.g, this.scene(view, this.box()), currentInks());
  }

  private scene(view: View, box: Box): Scene {
    const values = this.host.parameters();
    const [x, y] = [this.parameter("x"), this.parameter("y")];
    return {
      box,
      view,
      labels: { x: x?.symbol ?? "", y: y?.symbol ?? null },
      regimes: this.host.regimes(),
      lattice: this.lattice,
      memory: this.memory,
      landmarks: this.marks,
      mark: { x: values[x?.name ?? ""] ?? NaN, y: y ? values[y.name] : 0.5 },
    };
  }

  private parameter(axis: "x" | "y"): Parameter | undefined {
    const name = this.plane?.[axis]?.name;
    return this.host.model().parameters.find((one) => one.name === name);
  }

  private box(): Box {
    const left = this.plane?.y ? 62 : 14;
    const [width, height] = [this.sheet.width - left - 12, this.sheet.height - 8 - 42];
    return this.plane?.y ? { left, top: 8, width, height } : { left, top: 8 + height * 0.2, width, height: height * 0.6 };
  }

  /** Keeps the areas in sight as a picture, until the new map covers them. */
  private remember(): void {
    const view = this.window();
    if (!this.lattice || !view || this.sheet.width < 80) return;
    const box = { ...this.box(), left: 0, top: 0 };
    const picture = document.createElement("canvas");
    picture.width = Math.max(1, Math.round(box.width));
    picture.height = Math.max(1, Math.round(box.height));
    const g = picture.getContext("2d");
    if (g) paintCells(g, { ...this.scene(view, box), box }, currentInks());
    this.memory = { picture, view, outdated: this.outdated };
  }

  private ask(): void {
    const plane = this.plane && allowed(this.plane, this.host.model());
    if (!plane) return;
    const box = this.box();
    const across = plane.y ? Math.min(box.width, box.height) : box.width / 2;
    const count = Math.round(Math.max(24, Math.min(96, across / CELL)));
    this.epoch++;
    this.complete = false;
    this.host.send({ do: "map", epoch: this.epoch, ...plane, count });
  }

  private setPlane(plane: Plane): void {
    this.plane = plane;
    this.selectors.show(this.host.model(), plane);
    this.dirty = true;
  }

  private choosePlane(plane: Plane): void {
    if (this.plane && !sameAxes(plane, this.plane)) this.memory = this.lattice = null;
    this.legend.show([], []);
    this.go(plane);
  }

  /** Another window: shown at once, computed soon. */
  private go(plane: Plane): void {
    this.setPlane(plane);
    this.request();
    this.host.moved();
  }

  private reset(): void {
    if (this.home) this.choosePlane(this.home);
  }

  private zoomAt(factor: number, x: number, y: number): void {
    const box = this.box();
    if (this.plane) this.go(zoomed(this.plane, factor, (x - box.left) / box.width, 1 - (y - box.top) / box.height));
  }

  /** The parameters under a pixel, rounded to what a pixel resolves. */
  private under(px: number, py: number): Values | null {
    const [box, view] = [this.box(), this.window()];
    const [x, y] = [this.parameter("x"), this.parameter("y")];
    if (!view || !x || px < box.left || px > box.left + box.width || py < box.top || py > box.top + box.height) return null;
    const values: Values = { [x.name]: rounded(dataX(box, view, px), (view.x1 - view.x0) / box.width, x) };
    if (y) values[y.name] = rounded(dataY(box, view, py), (view.y1 - view.y0) / box.height, y);
    return values;
  }

  private click(px: number, py: number): void {
    const values = this.under(px, py);
    if (!values) return;
    const now = this.host.parameters();
    if (performance.now() - this.lastClick > 400) this.beforeClick = Object.fromEntries(Object.keys(values).map((name) => [name, now[name]]));
    this.lastClick = performance.now();
    this.host.choose(values);
  }

  private lastClick = -Infinity;

  /** A double click resets the window; the clicks it consists of shall not move the body. */
  private undoClicks(): void {
    if (Object.keys(this.beforeClick).length) this.host.choose(this.beforeClick);
    this.beforeClick = {};
    this.reset();
  }

  private hover(px: number, py: number): void {
    const values = this.under(px, py);
    if (values) this.pointAt(values);
    else this.readout.leave();
  }

  private pointAt(values: Values): void {
    const [x, y] = [this.parameter("x"), this.parameter("y")];
    if (!x) return;
    const at: [Parameter, number][] = [[x, values[x.name]]];
    if (y) at.push([y, values[y.name]]);
    this.readout.point(at, this.lattice?.cell(values[x.name], y ? values[y.name] : 0) ?? null);
  }

  private key(event: KeyboardEvent): void {
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
    const step = steps[event.key];
    const box = this.box();
    if (step) this.walk(step[0] * (event.shiftKey ? 8 : 1), step[1] * (event.shiftKey ? 8 : 1));
    else if (event.key === "+" || event.key === "=") this.zoomAt(1.25, ...this.markPixel(box));
    else if (event.key === "-" || event.key === "\u2212") this.zoomAt(0.8, ...this.markPixel(box));
    else if (event.key === "0" || event.key === "Home") this.reset();
    else return;
    event.preventDefault();
  }

  private markPixel(box: Box): [number, number] {
    const values = this.host.parameters();
    const y = this.parameter("y");
    const [px, py] = this.toPixel(values[this.parameter("x")?.name ?? ""], y ? values[y.name] : 0.5);
    const within = (p: number, from: number, size: number): number => (p >= from && p <= from + size ? p : from + size / 2);
    return [within(px, box.left, box.width), within(py, box.top, box.height)];
  }

  /** Moves the body's parameters by whole cells. */
  private walk(columns: number, rows: number): void {
    const [x, y, start] = [this.parameter("x"), this.parameter("y"), this.lattice?.start];
    if (!x || !start) return;
    const now = this.host.parameters();
    const values: Values = { [x.name]: rounded(now[x.name] + columns * start.x.step, start.x.step / 8, x) };
    if (y && start.y) values[y.name] = rounded(now[y.name] + rows * start.y.step, start.y.step / 8, y);
    this.host.choose(values);
    this.pointAt(values);
  }

  private say(text: string, fraction: number): void {
    setText(byId("map-progress-text"), text);
    byId<HTMLProgressElement>("map-progress-bar").value = fraction;
  }

  private showLegend(): void {
    if (!this.lattice) return;
    const regimes = this.host.regimes();
    this.legend.show(this.lattice.occurring().map((index) => regimes[index]), this.lattice.start.lines);
  }
}

function grouped(count: number): string {
  return String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, "\u2009");
}

/** A value with the digits that `resolution` deserves, within what the parameter allows. */
function rounded(value: number, resolution: number, { allowed: [low, high], whole }: Parameter): number {
  const decimals = whole ? 0 : decimalsOf(roundStep(resolution));
  return Math.min(high, Math.max(low, Number(value.toFixed(decimals))));
}

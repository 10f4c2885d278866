/** The map: asks the server for the window in sight, shows it, and takes the body to where one clicks. Its axes are parameters, or
 * coordinates of the start: then it shows basins. */

import type { Cells } from "../binary";
import { byId, throttle } from "../dom";
import { watch } from "../pointer";
import { pixelX, pixelY, type Box, type View } from "../plot";
import type { Evidence, Mapped, MapStart, Model, Parameter, Plane, Progress, Regime, Values, Wish } from "../protocol";
import { listenToKeys } from "./keys";
import { Legend } from "./legend";
import { rounded, under, type Sides } from "./pick";
import { MapPicture } from "./picture";
import { confined, panned, sameAxes, viewOf, zoomed } from "./plane";
import { showMapped, showProgress } from "./progress";
import { Readout } from "./readout";
import { AxisSelectors } from "./selectors";
import { side, variesStart } from "./sides";

/** What is drawn upon the map, and answers pointer and click where it is. */
export interface Upon {
  paintOnMap(g: CanvasRenderingContext2D, box: Box, view: View): void;
  /** The height that it needs beside a map of one axis. */
  lanesOnMap(): number;
  hoverOnMap(at: [number, number] | null, box: Box, view: View): boolean;
  clickOnMap(at: [number, number], box: Box, view: View): boolean;
}

/** What the map needs of the page. */
export interface MapHost {
  send(wish: Wish): void;
  regimes(): Regime[];
  model(): Model;
  /** The parameters, and what is known of the start. */
  parameters(): Values;
  /** Takes the body to these parameters, or lets it begin again at these coordinates. */
  choose(values: Values): void;
  /** The window or the axes are about to change; and have changed. */
  moves(): void;
  moved(): void;
  /** What else lies upon the map. */
  readonly upon: Upon;
}

/** The page asks for at most eight maps a second. */
const GAP = 125;
/** Pixels per cell, about; and how many cells along an axis at least and at most. */
const CELL = 6;
const CELLS = { least: 24, most: 90 };
/** Digits of the centre of a cell: this part of a cell is resolved. */
const RESOLVED = 1e-3;
/** Clicks that follow each other within so many milliseconds may be a double click. */
const DOUBLE = 400;

export class MapPanel {
  complete = false;
  private readonly picture: MapPicture;
  private readonly readout: Readout;
  private readonly legend = new Legend(byId("map-legend"));
  private readonly selectors = new AxisSelectors((plane) => this.choosePlane(plane));
  private readonly request = throttle(GAP, () => this.ask());
  private plane: Plane | null = null;
  /** The model whose map is shown. */
  private shown: Model | null = null;
  private home: Plane | null = null;
  private epoch = 0;
  private lastClick = -Infinity;
  private beforeClick: Values = {};
  /** Where the pointer is, in pixels. */
  private pointer: [number, number] | null = null;

  constructor(private readonly host: MapHost) {
    const canvas = byId<HTMLCanvasElement>("map");
    this.picture = new MapPicture(canvas, () => host.regimes(), (g, box, view) => host.upon.paintOnMap(g, box, view), () => host.upon.lanesOnMap());
    this.readout = new Readout(byId("readout"), () => host.regimes(), (cell) => host.send({ do: "evidence", epoch: this.epoch, cell }));
    watch(canvas, {
      click: (x, y) => this.click(x, y),
      double: () => this.undoClicks(),
      hover: (at) => this.hover(at),
      pan: (dx, dy) => this.pan(dx, dy),
      zoom: (factor, x, y) => this.zoomAt(factor, x, y),
    });
    listenToKeys(canvas, {
      walk: (columns, rows) => this.walk(columns, rows),
      zoom: (factor) => this.zoomAt(factor, ...this.markPixel()),
      reset: () => this.reset(),
    });
    canvas.addEventListener("blur", () => this.readout.leave());
    byId("map-reset").addEventListener("click", () => this.reset());
  }

  /** A new body: these axes, and `home` to come back to. Another model has nothing of what is shown. */
  begin(plane: Plane, home: Plane): void {
    this.forgetUnless(plane, this.shown === this.host.model());
    this.shown = this.host.model();
    this.home = home;
    this.setPlane(plane);
    this.renew();
  }

  /** Parameters off the axes changed: what is shown holds no longer. */
  renew(): void {
    this.picture.age();
    this.request();
  }

  /** Returns to a window, where it is another one. */
  return(plane: Plane): void {
    if (JSON.stringify(plane) === JSON.stringify(this.plane)) return;
    this.forgetUnless(plane);
    this.setPlane(plane);
    this.request();
    this.host.moved();
  }

  touch(): void {
    this.picture.touch();
  }

  /** The plane as it is, for the address and the server. */
  current(): Plane | null {
    return this.plane;
  }

  isAxis(name: string): boolean {
    return this.plane?.x.name === name || this.plane?.y?.name === name;
  }

  window(): View | null {
    return this.plane && viewOf(this.plane);
  }

  /** What the map has at the parameters of the body; `null` where it has nothing yet. */
  nameHere(): Regime | null {
    const [sides, lattice] = [this.sides(), this.picture.lattice];
    if (!sides || !lattice || this.picture.aged || this.shown !== this.host.model()) return null;
    if (this.plane && variesStart(this.shown, this.plane)) return null; // the body has long left its start
    const values = this.host.parameters();
    const cell = lattice.cell(values[sides.x.name], sides.y ? values[sides.y.name] : 0);
    return cell && lattice.verdict(cell);
  }

  /** Where a point of the plane is on the canvas, in CSS pixels. */
  toPixel(x: number, y: number): [number, number] {
    const [box, view] = [this.box(), this.window()];
    return view ? [pixelX(box, view, x), pixelY(box, view, y)] : [0, 0];
  }

  started(start: MapStart): void {
    const view = this.window();
    if (start.epoch !== this.epoch || !view) return;
    this.picture.start(start, view);
    showProgress({ done: 0, total: start.x.count * (start.y?.count ?? 1), rate: 0 });
    this.readout.renew();
    if (this.pointer) this.hover(this.pointer);
  }

  cells(cells: Cells): void {
    if (cells.epoch === this.epoch) this.picture.take(cells);
  }

  progress(progress: Progress): void {
    if (progress.epoch !== this.epoch) return;
    showProgress(progress);
    this.showLegend();
    this.readout.wait();
  }

  mapped(mapped: Mapped): void {
    if (mapped.epoch !== this.epoch) return;
    this.complete = true;
    this.picture.finish();
    showMapped(mapped);
    this.showLegend();
    this.readout.refresh();
  }

  evidence(evidence: Evidence): void {
    if (evidence.epoch === this.epoch) this.readout.answer(evidence);
  }

  draw(): void {
    const [view, sides] = [this.window(), this.sides()];
    if (!view || !sides) return;
    const values = this.host.parameters();
    this.picture.draw(view, sides, { x: values[sides.x.name], y: sides.y ? values[sides.y.name] : 0.5 });
  }

  private sides(): Sides | null {
    if (!this.plane) return null;
    const model = this.host.model();
    const x = side(model, this.plane.x.name);
    return x ? { x, y: side(model, this.plane.y?.name) ?? null } : null;
  }

  private box(): Box {
    return this.picture.box();
  }

  private ask(): void {
    const { plane } = this;
    if (!plane) return;
    const box = this.box();
    const across = plane.y ? Math.min(box.width, box.height) / CELL : box.width / 2;
    const count = Math.round(Math.max(CELLS.least, Math.min(CELLS.most, across)));
    this.epoch++;
    this.complete = false;
    this.host.send({ do: "map", epoch: this.epoch, ...plane, count });
  }

  private setPlane(plane: Plane): void {
    const model = this.host.model();
    this.plane = confined(plane, model);
    this.selectors.show(model, this.plane);
    this.picture.touch();
  }

  private choosePlane(plane: Plane): void {
    this.forgetUnless(plane);
    this.go(plane);
  }

  /** Other axes, or another model: nothing of what is shown holds. */
  private forgetUnless(plane: Plane, sameModel = true): void {
    if (!this.plane || (sameModel && sameAxes(plane, this.plane))) return;
    this.picture.forget();
    this.legend.show([], [], false);
  }

  /** Another window: shown at once, computed soon. */
  private go(plane: Plane): void {
    this.host.moves();
    this.setPlane(plane);
    this.request();
    this.host.moved();
  }

  private reset(): void {
    if (this.home) this.choosePlane(this.home);
  }

  /** What was pointed at moves away. */
  private pan(dx: number, dy: number): void {
    this.readout.leave();
    if (this.plane) this.go(panned(this.plane, this.box(), dx, dy));
  }

  private zoomAt(factor: number, x: number, y: number): void {
    const box = this.box();
    if (this.plane) this.go(zoomed(this.plane, factor, (x - box.left) / box.width, 1 - (y - box.top) / box.height));
  }

  private under(px: number, py: number): Values | null {
    const [view, sides] = [this.window(), this.sides()];
    return view && sides && under(px, py, this.box(), view, sides);
  }

  private click(px: number, py: number): void {
    const [under, view] = [this.under(px, py), this.window()];
    const values = under && this.centred(under);
    if (!values || !view || this.host.upon.clickOnMap([px, py], this.box(), view)) return;
    const [now, before] = [performance.now(), this.host.parameters()];
    if (now - this.lastClick > DOUBLE) this.beforeClick = Object.fromEntries(Object.keys(values).filter((name) => name in before).map((name) => [name, before[name]]));
    this.lastClick = now;
    this.host.choose(values);
  }

  /** A double click resets the window; the clicks it consists of shall not move the body. */
  private undoClicks(): void {
    this.host.choose(this.beforeClick);
    this.beforeClick = {};
    this.reset();
  }

  private hover(at: [number, number] | null): void {
    this.pointer = at;
    const [values, view] = [at && this.under(...at), this.window()];
    if (view) this.host.upon.hoverOnMap(values && at, this.box(), view);
    if (values) this.pointAt(values);
    else this.readout.leave();
  }

  /** Names the cell about a point, at the values it was computed at. */
  private pointAt(values: Values): void {
    const sides = this.sides();
    if (!sides) return;
    const centre = this.centred(values);
    const at: [Parameter, number][] = [sides.x, ...(sides.y ? [sides.y] : [])].map((side) => [side, centre[side.name]]);
    this.readout.point(at, this.cellAt(values));
  }

  /** The cell about a point in the map that was asked for last; `null` outside, and before the map has begun. */
  private cellAt(values: Values): [number, number] | null {
    const [sides, { lattice }] = [this.sides(), this.picture];
    if (!sides || !lattice || lattice.start.epoch !== this.epoch) return null;
    return lattice.cell(values[sides.x.name], sides.y ? values[sides.y.name] : 0);
  }

  /** The centre of the cell about a point: there its motion was computed. The point itself where there is no cell. */
  private centred(values: Values): Values {
    const [sides, cell, { lattice }] = [this.sides(), this.cellAt(values), this.picture];
    if (!sides || !cell || !lattice) return values;
    const [x, y] = lattice.centre(cell);
    const centre: Values = { [sides.x.name]: rounded(x, RESOLVED * lattice.start.x.step, sides.x) };
    if (sides.y && lattice.start.y) centre[sides.y.name] = rounded(y, RESOLVED * lattice.start.y.step, sides.y);
    return centre;
  }

  private markPixel(): [number, number] {
    const [box, values, sides] = [this.box(), this.host.parameters(), this.sides()];
    const [px, py] = sides ? this.toPixel(values[sides.x.name], sides.y ? values[sides.y.name] : 0.5) : [NaN, NaN];
    const within = (p: number, from: number, size: number): number => (p >= from && p <= from + size ? p : from + size / 2);
    return [within(px, box.left, box.width), within(py, box.top, box.height)];
  }

  /** Moves the body's parameters by whole cells. */
  private walk(columns: number, rows: number): void {
    const [sides, start] = [this.sides(), this.picture.lattice?.start];
    if (!sides || !start) return;
    const now = this.host.parameters();
    const moved = (side: Parameter, by: number, step: number): number => rounded((now[side.name] ?? side.default) + by * step, step / 8, side);
    const values: Values = { [sides.x.name]: moved(sides.x, columns, start.x.step) };
    if (sides.y && start.y) values[sides.y.name] = moved(sides.y, rows, start.y.step);
    this.host.choose(values);
    this.pointAt(values);
  }

  private showLegend(): void {
    const { lattice } = this.picture;
    const regimes = this.host.regimes();
    if (lattice) this.legend.show(lattice.occurring().map((index) => regimes[index]), lattice.start.lines, lattice.start.y === null);
  }
}

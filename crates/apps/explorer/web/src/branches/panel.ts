/** The branches of the body's motion: asks for them, draws them in a diagram and upon the map, and takes the body to where one clicks. */

import { byId, byTouch, setText } from "../dom";
import type { Box, View } from "../plot";
import type { Branch, BranchesStart, Followed, Following, Model, Parameter, Plane, Regime, Specials, Values, Wish } from "../protocol";
import { symbol } from "../symbols";
import { BranchControls } from "./controls";
import { Diagram } from "./diagram";
import { listenToBranchKeys } from "./keys";
import { showBranchLegend, showLegendOnMap } from "./legend";
import { lanesOf, onMap, paintOnMap } from "./painting";
import { BranchSet, type Spot } from "./set";
import { Tip } from "./tip";
import { describe } from "./words";

/** What the branches need of the page. */
export interface BranchHost {
  send(wish: Wish): void;
  regimes(): Regime[];
  model(): Model;
  parameters(): Values;
  plane(): Plane | null;
  /** The branches upon the map changed. */
  touchMap(): void;
}

/** So near a point (pixels) the pointer means it: in the diagram, and upon the map, whose clicks have another meaning too. */
const REACH = { diagram: 14, map: 6 };
/** Most branches that are followed at once. */
const MOST = 8;

export class BranchPanel {
  private set: BranchSet | null = null;
  private epoch = 0;
  private selected: Spot | null = null;
  private now = NaN;
  private readonly diagram: Diagram;
  private readonly controls: BranchControls;
  private readonly tip = new Tip(byId("branch-tip"));

  constructor(private readonly host: BranchHost) {
    const canvas = byId<HTMLCanvasElement>("branches");
    this.diagram = new Diagram(canvas);
    if (byTouch()) setText(byId("branch-how"), "Tap a branch for its numbers and to place the body on that motion. Where it is unstable, the body leaves it.");
    this.controls = new BranchControls({
      follow: (along) => this.follow(along),
      stop: () => this.stop(),
      show: () => {
        this.tip.hide();
        this.renew();
      },
      turned: () => this.tip.hide(),
    });
    canvas.addEventListener("pointermove", (event) => this.point(event));
    canvas.addEventListener("pointerleave", () => this.tip.hide());
    canvas.addEventListener("click", (event) => this.click(event));
    listenToBranchKeys(canvas, { walk: (by) => this.walk(by), turn: (by) => this.turn(by), special: (by) => this.toSpecial(by), take: () => this.selected && this.take(this.selected) });
    canvas.addEventListener("blur", () => this.tip.hide());
  }

  /** The parameter that branches are followed along. */
  get along(): string | null {
    return this.set?.start.along.name ?? null;
  }

  /** Another body, or other parameters off the axes: the branches hold no longer. */
  forget(): void {
    this.epoch++;
    this.set = this.selected = null;
    this.controls.rest("");
    this.tip.hide();
    this.renew();
  }

  /** The axes of the map: branches are followed along one of them. */
  axes(): void {
    const [plane, { parameters }] = [this.host.plane(), this.host.model()];
    const named = (name?: string): Parameter[] => parameters.filter((one) => one.name === name && !one.whole);
    this.controls.offer([...named(plane?.x.name), ...named(plane?.y?.name)]);
    this.renew();
  }

  begun(start: BranchesStart): void {
    if (start.epoch !== this.epoch) return;
    this.set = new BranchSet(start);
    this.renew();
  }

  branch(branch: Branch): void {
    if (branch.epoch !== this.epoch || !this.set) return;
    this.set.branches.push(branch);
    this.renew();
  }

  specials({ epoch, points }: Specials): void {
    if (epoch !== this.epoch || !this.set) return;
    this.set.specials = points;
    this.renew();
  }

  following({ epoch, done, branch }: Following): void {
    if (epoch === this.epoch) this.controls.progress(done, branch === 0 ? "finding the motion and its branch\u2026" : `following branch ${branch}\u2026`);
  }

  followed({ epoch, branches, left, seconds, why }: Followed): void {
    if (epoch !== this.epoch) return;
    if (why) return this.controls.fail(why);
    const more = left ? `; more may begin at ${left} other point${left === 1 ? "" : "s"}` : "";
    this.controls.rest(`${count(branches)} in ${seconds.toFixed(1)} s${more}`);
  }

  draw(): void {
    const now = this.set ? this.host.parameters()[this.set.start.along.name] : NaN;
    if (now !== this.now && this.set) this.renew();
    this.now = now;
    this.diagram.draw();
  }

  touch(): void {
    this.diagram.touch();
  }

  /** The height that the branches need beside a map of one axis. */
  lanesOnMap(): number {
    return this.isOnMap() ? lanesOf(this.set) : 0;
  }

  /** Upon the map: draws, or finds the point of a branch under a pixel. */
  paintOnMap(g: CanvasRenderingContext2D, box: Box, view: View): void {
    const plane = this.host.plane();
    if (this.set && plane) paintOnMap(g, this.set, plane, box, view, this.selected);
  }

  /** Whether the pointer upon the map is on a point of a branch: its tip is shown. `null`: the pointer left. */
  hoverOnMap(at: [number, number] | null, box: Box, view: View): boolean {
    const spot = at && this.onMap(at, box, view);
    if (spot && at) this.tell(spot, at);
    else this.tip.hide();
    return spot !== null;
  }

  /** Whether a click upon the map was one on a point of a branch. */
  clickOnMap(at: [number, number], box: Box, view: View): boolean {
    const spot = this.onMap(at, box, view);
    if (spot) this.take(spot);
    return spot !== null;
  }

  /** CSS pixels of a point in the diagram. */
  toPixel(branch: number, point: number): [number, number] | null {
    return this.diagram.place({ branch, point });
  }

  private onMap(at: [number, number], box: Box, view: View): Spot | null {
    const plane = this.host.plane();
    const place = this.set && plane && onMap(this.set, plane, box, view);
    return (place && this.set?.nearest(place, at, REACH.map)) ?? null;
  }

  private isOnMap(): boolean {
    const plane = this.host.plane();
    return this.along !== null && (plane?.x.name === this.along || plane?.y?.name === this.along);
  }

  private follow(name: string): void {
    const plane = this.host.plane();
    const along = [plane?.x, plane?.y].find((axis) => axis?.name === name);
    if (!along) return;
    this.forget();
    this.controls.progress(0, "finding the motion and its branch\u2026");
    this.host.send({ do: "follow", epoch: this.epoch, along: { ...along }, branches: MOST });
  }

  private stop(): void {
    this.host.send({ do: "unfollow" });
    this.controls.rest(`stopped; ${count(this.set?.branches.length ?? 0)}`);
  }

  private parameter(): Parameter | null {
    return this.host.model().parameters.find((one) => one.name === this.along) ?? null;
  }

  private renew(): void {
    const { set, selected } = this;
    const [parameter, ordinate] = [this.parameter(), this.controls.ordinate()];
    const filled = set && set.branches.length > 0 && parameter;
    this.diagram.show(filled ? { set, ordinate, parameter, now: this.host.parameters()[parameter.name], selected, regimes: this.host.regimes() } : null);
    showBranchLegend(byId("branch-legend"), filled ? set : null, this.host.regimes());
    showLegendOnMap(byId("map-branch-legend"), filled && this.isOnMap() ? set : null, filled ? this.others(set) : []);
    this.controls.explain(!filled);
    byId("branch-others").replaceChildren(...(filled ? this.others(set) : []));
    this.host.touchMap();
  }

  /** The other parameter of the map, as it was. */
  private others({ start }: BranchSet): (Node | string)[] {
    const plane = this.host.plane();
    const name = [plane?.x.name, plane?.y?.name].find((one) => one !== undefined && one !== start.along.name);
    const other = this.host.model().parameters.find((one) => one.name === name);
    return other ? ["at ", symbol(other.symbol), ` = ${start.parameters[other.name]}`] : [];
  }

  private under(at: [number, number]): Spot | null {
    return this.set?.nearest((spot) => this.diagram.place(spot), at, REACH.diagram) ?? null;
  }

  private point(event: PointerEvent): void {
    const at: [number, number] = [event.offsetX, event.offsetY];
    const spot = this.under(at);
    if (spot) this.tell(spot, this.diagram.place(spot) ?? at);
    else this.tip.hide();
  }

  private click(event: MouseEvent): void {
    const spot = this.under([event.offsetX, event.offsetY]);
    if (spot) this.take(spot);
  }

  private tell(spot: Spot, at: [number, number]): void {
    const parameter = this.parameter();
    if (this.set && parameter) this.tip.show(describe(this.set, spot, parameter), at);
  }

  /** Takes the body to a point. */
  private take(spot: Spot): void {
    this.select(spot);
    this.host.send({ do: "place", epoch: this.epoch, ...spot });
  }

  private select(spot: Spot): void {
    this.selected = spot;
    this.renew();
  }

  /** By keys: along a branch, to the next branch, to the next special point. */
  private walk(by: number): void {
    const from = this.selected ?? { branch: 0, point: 0 };
    const last = (this.set?.branches[from.branch]?.parameter.length ?? 0) - 1;
    if (last >= 0) this.go({ ...from, point: Math.min(last, Math.max(0, from.point + by)) });
  }

  private turn(by: number): void {
    const total = this.set?.branches.length ?? 0;
    const branch = (((this.selected?.branch ?? 0) + by) % total + total) % total;
    if (total) this.go({ branch, point: Math.floor(((this.set?.branches[branch].parameter.length ?? 1) - 1) / 2) });
  }

  private toSpecial(by: number): void {
    const all = this.set?.specials ?? [];
    const here = all.findIndex((one) => one.branch === this.selected?.branch && one.point === this.selected.point);
    const next = all[here < 0 ? 0 : (here + by + all.length) % all.length];
    if (next) this.go({ branch: next.branch, point: next.point });
  }

  private go(spot: Spot): void {
    this.select(spot);
    const at = this.diagram.place(spot);
    if (at) this.tell(spot, at);
  }
}

function count(branches: number): string {
  return `${branches} branch${branches === 1 ? "" : "es"}`;
}

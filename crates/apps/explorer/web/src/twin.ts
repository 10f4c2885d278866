/** Compare: the place that was held goes on beside the body, with a connection of its own. */

import type { Place } from "./address";
import type { Frame } from "./binary";
import { Camera } from "./body/camera";
import { Backdrop } from "./body/backdrop";
import { paintBody } from "./body/painting";
import { Sheet } from "./canvas";
import { FULL } from "./connection";
import { byId, make } from "./dom";
import { KEPT } from "./editor";
import { hideHalf, showHalf, type Beside } from "./half";
import { History } from "./history";
import type { Connect, Transport } from "./listener";
import { pretty } from "./numbers";
import { SEED } from "./opening";
import type { Answer, Begun, Model, Regime } from "./protocol";
import { swatch } from "./glyphs";
import { recall } from "./stored";
import { symbol } from "./symbols";
import { currentInks, edge, visible } from "./theme";
import { toast } from "./toasts";

/** Model time of the trail, in seconds of the wall. */
const TRAIL = 15;
/** So many parameters are named. */
const MOST = 3;
/** Radius of the body in pixels, at least. */
const SMALLEST = 15;

/** What is held. */
export interface Holding {
  place: Place;
  model: Model;
  /** The parameters that are shown: those along the axes of the map first. */
  names: string[];
  values: Record<string, number>;
  regimes: Regime[];
  /** Of its lengths; `null`: the model's own. */
  unit: string | null;
}

export class Twin implements Beside {
  private readonly connection: Transport;
  private readonly history = new History();
  private readonly camera = new Camera();
  private readonly backdrop = new Backdrop();
  private readonly sheet = new Sheet(byId<HTMLCanvasElement>("twin"), () => (this.dirty = true), true);
  private frame: Frame | null = null;
  private outline: Float64Array | null = null;
  private regime: Regime | null = null;
  private revision = -1;
  private waiting = false;
  private speed = 1;
  private dirty = true;

  constructor(
    connect: Connect,
    private readonly holding: Holding,
    private readonly ended: () => void,
  ) {
    this.connection = connect({
      answer: (answer) => this.hear(answer),
      frame: (frame) => this.take(frame),
      cells: () => undefined,
      file: () => undefined,
      swarm: () => undefined,
      open: (open, code) => this.opened(open, code),
    });
    this.camera.unit = holding.unit;
    showHalf("The place that is held, to compare with", "End the comparison");
    this.label();
  }

  end(): void {
    this.connection.end();
    hideHalf();
    this.ended();
  }

  private opened(open: boolean, code: number): void {
    this.waiting = false;
    this.revision = open ? this.revision : -1;
    if (code !== FULL) return;
    toast("To compare, the server needs a free place: close another page.");
    this.end();
  }

  private hear(answer: Answer): void {
    if (answer.is === "hello") this.begin();
    else if (answer.is === "begun") this.begun(answer);
    else if (answer.is === "named") this.name(answer.regime);
    else if (answer.is === "refused") toast(answer.why);
  }

  private begin(): void {
    const { model, preset, parameters, state, position, t, noise } = this.holding.place;
    const text = recall("sessionStorage", KEPT);
    if (model === "edited" && text !== null) this.connection.send({ do: "define", text });
    // After a loss of the connection it goes on where it was.
    const { frame } = this;
    const now = frame ? { state: [...frame.state], position: [frame.x, frame.y] as [number, number], t: frame.t } : { state, position, t };
    this.connection.send({ do: "begin", model, preset, parameters, ...now, noise, seed: SEED });
  }

  private begun({ revision, speed }: Begun): void {
    this.revision = revision;
    this.speed = this.holding.place.speed ?? speed;
    this.advance(0);
  }

  private name(regime: string): void {
    this.regime = this.holding.regimes.find((one) => one.name === regime) ?? null;
    this.dirty = true;
    this.label();
  }

  /** The name and the parameters, above the picture. */
  private label(): void {
    const { model, names, values } = this.holding;
    const shown = names.slice(0, MOST).flatMap((name) => {
      const parameter = model.parameters.find((one) => one.name === name);
      return parameter ? [make("span", {}, symbol(parameter.symbol), ` = ${pretty(values[name])}`)] : [];
    });
    byId("twin-label").replaceChildren(...(this.regime ? [swatch(this.regime, 14)] : []), make("b", {}, this.regime?.words ?? "classifying\u2026"), ...shown);
  }

  private take(frame: Frame): void {
    this.waiting = false;
    this.history.take(frame);
    this.frame = frame;
    if (frame.outlined && frame.outline.length) this.outline = frame.outline;
    this.dirty = true;
  }

  private advance(dt: number): void {
    this.waiting = true;
    this.connection.send({ do: "advance", dt });
  }

  /** Moves on by `seconds` where the page moves, and draws. */
  draw(seconds: number, moving: boolean): void {
    if (moving && this.revision >= 0 && !this.waiting) this.advance(this.speed * seconds);
    const { frame, camera, sheet, history } = this;
    if (!frame || !sheet.width) return;
    [camera.width, camera.height] = [sheet.width, sheet.height];
    const from = history.since(frame.t - TRAIL * this.speed);
    camera.aim(history, from, frame.x, frame.y, frame.radius);
    const enlarged = Math.max(1, SMALLEST / (frame.radius * camera.scale));
    camera.drawn = frame.radius * enlarged;
    if (!camera.step(seconds) && !this.dirty) return;
    this.dirty = false;
    const colour = visible(this.regime?.colour ?? "#888888");
    const scene = { camera, history, from, frame, outline: this.outline, enlarged, colour, edge: edge(colour), pointed: -1 };
    this.backdrop.paint(sheet, scene, currentInks());
    paintBody(sheet.g, scene, currentInks());
  }

  touch(): void {
    this.backdrop.forget();
    this.dirty = true;
  }

  shown(): Frame | null {
    return this.frame;
  }
}

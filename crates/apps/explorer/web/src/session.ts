/** What the page knows about the body: model, preset, parameters, and the changes that are under way. */

/** A `set` without an answer for so long (milliseconds) holds up no other. */
const PATIENCE = 500;

import type { Begun, Changed, Model, Parameter, Preset, Registry, Tracked, Values } from "./protocol";

export class Session {
  model: Model;
  preset: Preset | null = null;
  /** The preset's values over the model's defaults. */
  base: Values = {};
  /** As the reader has them now; the server may still refuse. */
  parameters: Values = {};
  /** Coordinates at which the body began, where the reader chose them. */
  start: Values = {};
  /** As the server has them. */
  private confirmed: Values = {};
  noise = 0;
  revision = 0;
  speed = 1;
  /** The `set` on its way to the server. */
  private underway: Values | null = null;
  private sent = -Infinity;
  private wanted: Values = {};

  /** `tracked`: the cell that one of the models was fitted to. */
  constructor(
    readonly registry: Registry,
    readonly tracked: Tracked | null,
  ) {
    this.model = registry.models[0];
  }

  /** Another model or preset, before the server answers. */
  choose(model: string, preset: string | null, parameters: Values): void {
    const { models, presets } = this.registry;
    this.model = models.find((one) => one.name === model) ?? models[0];
    this.preset = presets.find((one) => one.name === preset) ?? null;
    const defaults = Object.fromEntries(this.model.parameters.map((one) => [one.name, one.default]));
    this.base = { ...defaults, ...this.preset?.parameters };
    this.parameters = { ...this.base, ...parameters };
    this.confirmed = this.parameters;
    this.start = {};
    this.underway = null;
    this.wanted = {};
  }

  /** A model that the page wrote; it replaces an earlier one of the same name. */
  define(model: Model): void {
    const { models } = this.registry;
    const at = models.findIndex((one) => one.name === model.name);
    models.splice(at < 0 ? models.length : at, at < 0 ? 0 : 1, model);
  }

  /** The noise, where it is not that of the model. */
  noised(): number | null {
    return this.noise === this.model.noise ? null : this.noise;
  }

  /** Only the parameters that differ from the preset's. */
  changed(): Values {
    return Object.fromEntries(Object.entries(this.parameters).filter(([name, value]) => value !== this.base[name]));
  }

  /** The parameters themselves. */
  departed(): Parameter[] {
    const changed = this.changed();
    return this.model.parameters.filter((one) => one.name in changed);
  }

  begun({ revision, parameters, noise }: Begun, speed: number): void {
    Object.assign(this, { revision, noise, speed, confirmed: parameters, parameters: { ...parameters } });
  }

  /** Notes a value for the next `set`. */
  want(values: Values): void {
    Object.assign(this.wanted, values);
    Object.assign(this.parameters, values);
  }

  /** The next `set`: one at a time, so that a slider never runs ahead of the server. `null` where there is none. */
  take(now: number): Values | null {
    if (Object.keys(this.wanted).length === 0 || (this.underway && now - this.sent < PATIENCE)) return null;
    this.underway = this.wanted;
    this.wanted = {};
    this.sent = now;
    return this.underway;
  }

  /** The server agreed. What was wanted meanwhile stays wanted. Gives the parameters that nobody here asked to change. */
  agreed({ revision, parameters, noise }: Changed): string[] {
    const before = this.parameters;
    const { underway } = this;
    if (underway && Object.entries(underway).every(([name, value]) => parameters[name] === value)) this.underway = null;
    Object.assign(this, { revision, noise, confirmed: parameters });
    this.parameters = { ...parameters, ...this.underway, ...this.wanted };
    return Object.keys(parameters).filter((name) => before[name] !== this.parameters[name]);
  }

  /** The server refused something; where it names a parameter of the `set` under way, that one is undone. */
  refused(why: string): string[] {
    const names = Object.keys(this.underway ?? {});
    if (!names.some((name) => new RegExp(`\\b${name}\\b`).test(why))) return [];
    this.underway = null;
    this.parameters = { ...this.confirmed, ...this.wanted };
    return names;
  }
}

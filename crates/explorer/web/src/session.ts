/** What the page knows about the body: model, preset, parameters, and the changes that are under way. */

import type { Begun, Changed, Model, Preset, Registry, Values } from "./protocol";

export class Session {
  model: Model;
  preset: Preset | null = null;
  /** The preset's values over the model's defaults. */
  base: Values = {};
  /** As the reader has them now; the server may still refuse. */
  parameters: Values = {};
  /** As the server has them. */
  private confirmed: Values = {};
  noise = 0;
  revision = 0;
  speed = 1;
  /** Sets on their way to the server, the oldest first. */
  private readonly underway: Values[] = [];
  private wanted: Values = {};

  constructor(readonly registry: Registry) {
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
    this.underway.length = 0;
    this.wanted = {};
  }

  /** Only the parameters that differ from the preset's. */
  changed(): Values {
    return Object.fromEntries(Object.entries(this.parameters).filter(([name, value]) => value !== this.base[name]));
  }

  begun({ revision, parameters, noise }: Begun, speed: number): void {
    Object.assign(this, { revision, noise, speed, confirmed: parameters, parameters: { ...parameters } });
  }

  /** Notes a value for the next `set`. */
  want(values: Values): void {
    Object.assign(this.wanted, values);
    Object.assign(this.parameters, values);
  }

  /** The next `set`, at most one per frame; `null` where nothing changed. */
  take(): Values | null {
    if (Object.keys(this.wanted).length === 0) return null;
    const values = this.wanted;
    this.wanted = {};
    this.underway.push(values);
    return values;
  }

  /** The server agreed. What was wanted meanwhile stays wanted. */
  agreed({ revision, parameters, noise }: Changed): void {
    const first = this.underway[0];
    if (first && Object.entries(first).every(([name, value]) => parameters[name] === value)) this.underway.shift();
    Object.assign(this, { revision, noise, confirmed: parameters });
    this.parameters = Object.assign({ ...parameters }, ...this.underway, this.wanted);
  }

  /** The server refused something; where it names a parameter of a `set` under way, that one is undone. */
  refused(why: string): string[] {
    const at = this.underway.findIndex((values) => Object.keys(values).some((name) => new RegExp(`\\b${name}\\b`).test(why)));
    if (at < 0) return [];
    const [values] = this.underway.splice(at, 1);
    this.parameters = Object.assign({ ...this.confirmed }, ...this.underway, this.wanted);
    return Object.keys(values);
  }
}

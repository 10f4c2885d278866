/** The whole state of the page as readable `key=value` pairs behind the # of its address. */

import { side } from "./map/sides";
import { MOST_NOISE } from "./controls";
import { plain } from "./numbers";
import { Tour } from "./tour/tour";
import type { Axis, Model, Plane, Registry, Section, Values } from "./protocol";

/** What an address says; whatever it leaves out comes from the preset. */
export interface Place {
  model: string;
  preset: string | null;
  /** Only those that differ from the preset's. */
  parameters: Values;
  plane: Plane | null;
  speed: number | null;
  /** `null`: that of the model. */
  noise: number | null;
  section: Section | null;
  y: number | null;
  playing: boolean;
  /** Step of the tour; `null`: none. */
  tour: number | null;
  t: number;
  position: [number, number] | null;
  state: number[] | null;
}

const axisText = ({ name, low, high }: Axis): string => `${name}:${plain(low, 10)}:${plain(high, 10)}`;

/** The address of a place, `#` included. */
export function write(place: Place): string {
  const pairs: [string, string | number][] = [["model", place.model]];
  if (place.preset) pairs.push(["preset", place.preset]);
  pairs.push(...Object.entries(place.parameters));
  if (place.plane) pairs.push(["x", axisText(place.plane.x)], ["y", place.plane.y ? axisText(place.plane.y) : "none"]);
  if (place.speed !== null) pairs.push(["speed", plain(place.speed, 4)]);
  if (place.noise !== null) pairs.push(["noise", place.noise]);
  if (place.section) pairs.push(["section", place.section === "path" && place.y !== null ? `path:${place.y}` : place.section]);
  if (place.tour !== null) pairs.push(["tour", place.tour]);
  pairs.push(["play", place.playing ? 1 : 0]);
  if (place.state && place.position) pairs.push(["t", place.t], ["at", place.position.join()], ["state", place.state.join()]);
  return `#${pairs.map(([key, value]) => `${key}=${value}`).join("&")}`;
}

/** Reads an address. What cannot be used is left aside and named in `notes`. */
export function read(hash: string, registry: Registry): { place: Place; notes: string[] } {
  const pairs = new Map<string, string>();
  for (const pair of hash.replace(/^#/, "").split("&").filter(Boolean)) {
    const at = pair.indexOf("=");
    if (at > 0) pairs.set(decoded(pair.slice(0, at)), decoded(pair.slice(at + 1)));
  }
  // A step of the tour alone means its place.
  const tour = step(finite(pairs.get("tour") ?? ""));
  if (tour !== null && pairs.size === 1) return read(`${Tour.place(tour)}&tour=${tour}`, registry);
  return new Reader(pairs, registry).read();
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

class Reader {
  private readonly notes: string[] = [];

  constructor(
    private readonly pairs: Map<string, string>,
    private readonly registry: Registry,
  ) {}

  read(): { place: Place; notes: string[] } {
    const { model, preset } = this.subject();
    const section = this.take("section", (text) => {
      const [kind, y] = text.split(":");
      if (kind !== "speed" && kind !== "path") return null;
      return { kind: kind as Section, y: y === undefined ? null : finite(y) };
    });
    const place: Place = {
      model: model.name,
      preset,
      plane: this.plane(model),
      speed: this.take("speed", (text) => positive(finite(text))),
      noise: this.take("noise", (text) => amplitude(finite(text))),
      section: section?.kind ?? null,
      y: section?.y ?? null,
      playing: this.take("play", (text) => (text === "0" || text === "1" ? { on: text === "1" } : null))?.on ?? true,
      tour: this.take("tour", (text) => step(finite(text))),
      t: this.take("t", finite) ?? 0,
      position: this.take("at", (text) => numbers(text, 2)) as [number, number] | null,
      state: this.take("state", (text) => numbers(text, null)),
      parameters: this.parameters(model),
    };
    if (!place.state || !place.position) Object.assign(place, { state: null, position: null, t: 0 });
    return { place, notes: this.notes };
  }

  /** A preset decides the model; an unknown one leaves it to the first preset, or to the model that is named. */
  private subject(): { model: Model; preset: string | null } {
    const { models, presets } = this.registry;
    const named = this.take("model", (text) => models.find((one) => one.name === text) ?? null);
    const preset = this.take("preset", (text) => presets.find((one) => one.name === text && (!named || named.name === one.model)) ?? null);
    const chosen = preset ?? (named ? null : (presets.find((one) => one.name === "fig5a") ?? presets[0] ?? null));
    const model = named ?? models.find((one) => one.name === chosen?.model) ?? models[0];
    return { model, preset: chosen?.name ?? null };
  }

  private plane(model: Model): Plane | null {
    const axis = (text: string): Axis | null => {
      const [name, low, high] = text.split(":");
      const [a, b] = [finite(low ?? ""), finite(high ?? "")];
      return side(model, name) && a !== null && b !== null && a < b ? { name, low: a, high: b } : null;
    };
    const x = this.take("x", axis);
    const y = this.take("y", (text) => (text === "none" ? "none" : axis(text)));
    if (!x || !y || (y !== "none" && y.name === x.name)) return null;
    return { x, y: y === "none" ? null : y };
  }

  /** Everything that is left must be a parameter. */
  private parameters(model: Model): Values {
    const out: Values = {};
    for (const name of [...this.pairs.keys()]) {
      const parameter = model.parameters.find((one) => one.name === name);
      const value = this.take(name, (text) => {
        const number = finite(text);
        return parameter && number !== null && number >= parameter.allowed[0] && number <= parameter.allowed[1] ? { number } : null;
      });
      if (value) out[name] = value.number;
    }
    return out;
  }

  /** The value of a key, read; `null` where it is missing or, with a note, where it cannot be used. */
  private take<T>(key: string, parse: (text: string) => T | null): T | null {
    const text = this.pairs.get(key);
    this.pairs.delete(key);
    if (text === undefined) return null;
    const value = parse(text);
    if (value === null) this.notes.push(`${key}=${text.length > 24 ? `${text.slice(0, 24)}\u2026` : text}`);
    return value;
  }
}

function finite(text: string): number | null {
  const value = text.trim() === "" ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

const step = (value: number | null): number | null => (value !== null && Number.isInteger(value) && value >= 1 && value <= Tour.length ? value : null);
const positive = (value: number | null): number | null => (value !== null && value > 0 ? value : null);
const amplitude = (value: number | null): number | null => (value !== null && value >= 0 && value <= MOST_NOISE ? value : null);

function numbers(text: string, count: number | null): number[] | null {
  const values = text.split(",").map(finite);
  if (values.some((value) => value === null) || (count !== null && values.length !== count)) return null;
  return values as number[];
}

/** The beginning of a preset or model, everything else left to it. */
export function fresh(model: string, preset: string | null, playing: boolean): Place {
  return { model, preset, parameters: {}, plane: null, speed: null, noise: null, section: null, y: null, playing, tour: null, t: 0, position: null, state: null };
}

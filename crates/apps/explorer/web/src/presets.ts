/** The presets as chips, one click each, and the selector of the model. */

import { byId, make } from "./dom";
import type { Model, Parameter, Registry } from "./protocol";
import { spoken, symbol } from "./symbols";

/** So many changed parameters are named. */
const MOST = 4;

export class PresetBar {
  private readonly place = byId("presets");
  private readonly select = byId<HTMLSelectElement>("model");

  constructor(
    private readonly preset: (name: string) => void,
    model: (name: string) => void,
  ) {
    this.select.addEventListener("change", () => model(this.select.value));
  }

  /** Fills the bar from the registry. */
  fill({ presets, models }: Registry): void {
    this.place.replaceChildren(...presets.map(({ name, title }) => {
      const chip = make("button", { type: "button", class: "chip", "data-preset": name, "data-testid": `preset-${name}`, title, "aria-label": `${name}: ${title}`, "aria-pressed": "false" }, name);
      chip.addEventListener("click", () => this.preset(name));
      return chip;
    }));
    this.select.replaceChildren();
    models.forEach((model) => this.add(model));
  }

  /** A model that can be chosen. */
  add({ name, title }: Model): void {
    if (![...this.select.options].some((one) => one.value === name)) this.select.append(make("option", { value: name, title }, name));
  }

  /** Shows which ones are in use, and the sentence about them. */
  show(model: Model, preset: string | null, about: string): void {
    this.select.value = model.name;
    byId("about-text").replaceChildren(...prose(about, model.parameters));
    for (const chip of this.place.querySelectorAll<HTMLElement>(".chip")) {
      const chosen = chip.dataset.preset === preset;
      if (chosen && chip.getAttribute("aria-pressed") !== "true") this.reveal(chip);
      chip.setAttribute("aria-pressed", String(chosen));
    }
  }

  /** Scrolls the bar to a chip. (`scrollIntoView` would move the place from which the tab key goes on, too.) */
  private reveal(chip: HTMLElement): void {
    const [bar, one] = [this.place.getBoundingClientRect(), chip.getBoundingClientRect()];
    this.place.scrollLeft += Math.min(one.left - bar.left, 0) + Math.max(one.right - bar.right, 0);
  }

  /** Shows what the reader changed since: the sentence about the preset may hold no longer. */
  depart(parameters: Parameter[]): void {
    const place = byId("departed");
    const names = parameters.map((one) => one.name).join();
    if (place.dataset.names === names) return;
    place.dataset.names = names;
    place.hidden = !names;
    const symbols = parameters.slice(0, MOST).flatMap((one, i) => [...(i ? [", "] : []), symbol(one.symbol)]);
    place.replaceChildren("changed: ", ...symbols, parameters.length > MOST ? ", \u2026" : "");
    this.place.toggleAttribute("data-departed", names !== "");
  }
}

/** A word that may be a symbol, with its index and its power; and an arrow. */
const WORD = /(->|\b[A-Za-z]+\d*(?:_[A-Za-z0-9]+)?(?:\^-?\d+)?)/;

/** The text with typeset symbols: names of parameters become their symbols, and indices and powers are set. */
function prose(text: string, parameters: Parameter[]): (Node | string)[] {
  return text.split(WORD).map((part, i) => (i % 2 ? worded(part, parameters) : part));
}

/** Names that are words, too, are left as they are. */
function worded(word: string, parameters: Parameter[]): Node | string {
  if (word === "->") return "\u2192";
  const [, name, index, power] = word.match(/^([A-Za-z]+\d*)(?:_([A-Za-z0-9]+))?(?:\^(-?\d+))?$/) ?? [];
  const own = parameters.find((one) => one.name === name)?.symbol ?? null;
  const formal = own !== null && /\d|[\u0370-\u03ff]/.test(spoken(own));
  if (index === undefined && power === undefined) return own !== null && formal ? symbol(own) : word;
  const base = own !== null && formal ? own : name.length === 1 ? `*${name}*` : name;
  return symbol(`${base}${index === undefined ? "" : `_{*${index}*}`}${power === undefined ? "" : `^{${power}}`}`);
}

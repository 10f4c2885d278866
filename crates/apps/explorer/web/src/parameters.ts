/** The panel of parameters: one row each, grouped by equation, those of the figure first. */

import { byId, make } from "./dom";
import { equations } from "./equations";
import { readNumber } from "./fields";
import { decimalsOf, fitting, given, roundStep } from "./numbers";
import type { Model, Parameter, Preset, Values } from "./protocol";
import { spoken, symbol, symbolWidth } from "./symbols";

/** A slider goes over its range in at least so many steps, each a round number. */
const STEPS = 400;
/** Room for a symbol beside its slider, and its size; a wider one has a line of its own. */
const BESIDE = 44;
const SIZE = 17;
/** So many characters fit into the field of a number. */
const FIELD = 9;

interface Row {
  parameter: Parameter;
  element: HTMLElement;
  slider: HTMLInputElement;
  number: HTMLInputElement;
  reset: HTMLButtonElement;
  mark: HTMLElement;
  refusal: HTMLElement;
}

export class ParameterPanel {
  private readonly place = byId("parameters");
  private rows: Row[] = [];
  private base: Values = {};
  private values: Values = {};
  /** What sliders go over that are finer than their parameter's range: the window of the figure. */
  private spans = new Map<string, [number, number]>();

  /** `set` hears each value that the reader chooses; `edit` is asked for the equations as text. */
  constructor(
    private readonly set: (name: string, value: number) => void,
    private readonly edit: () => void,
  ) {
    const details = byId<HTMLDetailsElement>("parameter-details");
    const phone = matchMedia("(max-width: 700px)");
    const fold = (): void => void (details.open = !phone.matches);
    phone.addEventListener("change", fold);
    fold();
  }

  /** The rows of a model; `base` holds the values that a reset comes back to. */
  begin(model: Model, preset: Preset | null, base: Values): void {
    this.base = base;
    this.rows = [];
    const plane = preset?.plane ?? model.plane;
    this.spans = new Map([plane.x, ...(plane.y ? [plane.y] : [])].map(({ name, low, high }) => [name, [low, high]]));
    const given = preset?.free ?? [];
    const free = given.length ? given : [plane.x.name, plane.y?.name ?? ""];
    const first = model.parameters.filter((one) => free.includes(one.name));
    const groups = new Map<string, Parameter[]>();
    for (const one of model.parameters) {
      const others = groups.get(one.equation) ?? [];
      groups.set(one.equation, free.includes(one.name) ? others : [...others, one]);
    }
    this.place.replaceChildren(
      make("details", { class: "equations" }, make("summary", {}, "Equations"), equations(model), make("p", {}, model.source), ...this.change(model)),
      ...(first.length ? [this.group(given.length ? "free in the paper\u2019s figure" : `axes of the ${preset ? "preset" : "model"}\u2019s map`, first)] : []),
      ...[...groups].filter(([, list]) => list.length).map(([equation, list]) => this.group(equation.startsWith("(") ? `equation ${equation}` : equation, list)),
    );
  }

  /** The button that opens the equations as text. */
  private change(model: Model): HTMLElement[] {
    if (!model.editable) return [];
    const button = make("button", { type: "button", "data-testid": "edit-equations", title: "Add terms, parameters or modes, and run the result" }, "Change the equations\u2026");
    button.addEventListener("click", () => this.edit());
    return [button];
  }

  /** Shows these values; the field that is being typed in is left alone. */
  show(values: Values): void {
    this.values = values;
    for (const { parameter, slider, number, reset } of this.rows) {
      const value = values[parameter.name];
      if (value === undefined) continue;
      slider.value = String(value);
      if (document.activeElement !== number) this.write(number, value);
      reset.classList.toggle("shown", value !== this.base[parameter.name]);
      reset.disabled = value === this.base[parameter.name];
    }
  }

  /** As much of a value as its field holds; all of it where one points. */
  private write(number: HTMLInputElement, value: number): void {
    number.value = fitting(value, FIELD);
    number.title = given(value);
  }

  /** Marks the axes of the map. */
  markAxes(x: string | null, y: string | null): void {
    for (const { parameter, mark } of this.rows) {
      const axis = parameter.name === x ? "x" : parameter.name === y ? "y" : "";
      mark.textContent = axis;
      mark.title = axis ? `axis of the map (${axis === "x" ? "horizontal" : "vertical"})` : "";
    }
  }

  /** Shows the server's refusal at the row it is about; tells whether there was one. */
  refuse(names: string[], why: string): boolean {
    const row = this.rows.find((one) => names.includes(one.parameter.name));
    if (!row) return false;
    row.refusal.textContent = why;
    row.refusal.hidden = false;
    return true;
  }

  private group(title: string, parameters: Parameter[]): HTMLElement {
    const rows = parameters.map((one) => this.row(one));
    this.rows.push(...rows);
    return make("fieldset", {}, make("legend", {}, title), ...rows.map((row) => row.element));
  }

  private row(parameter: Parameter): Row {
    const [low, high] = this.spans.get(parameter.name) ?? parameter.range;
    const { name, meaning, equation, whole } = parameter;
    const id = `about-${name}`;
    const step = whole ? 1 : roundStep((high - low) / STEPS);
    const round = (edge: number): string => String(snapped(step * Math.round(edge / step), step));
    const about = make("button", { type: "button", class: "symbol-button", "aria-expanded": "false", "aria-controls": id, title: `${name}: ${meaning}`, "aria-label": `${spoken(parameter.symbol)} (${name}): meaning` }, symbol(parameter.symbol));
    const text = make("p", { id, class: "meaning", hidden: "" }, `${name}, equation ${equation}: ${meaning}`);
    const mark = make("span", { class: "axis-mark" });
    const slider = make("input", { type: "range", min: round(low), max: round(high), step: String(step), "aria-label": name });
    const number = make("input", { type: "text", inputmode: "decimal", class: "number", autocomplete: "off", "aria-label": `${name}, value` });
    const reset = make("button", { type: "button", class: "reset", title: "Reset to the value of the preset", "aria-label": `Reset ${name}` }, "\u21ba");
    const refusal = make("p", { class: "refusal", role: "alert", hidden: "" });
    const element = make("div", { class: symbolWidth(parameter.symbol, SIZE) > BESIDE ? "parameter wide" : "parameter", "data-parameter": name, "data-testid": `parameter-${name}` }, about, mark, slider, number, reset, text, refusal);
    about.addEventListener("click", () => {
      text.hidden = !text.hidden;
      about.setAttribute("aria-expanded", String(!text.hidden));
    });
    const choose = (value: number): void => {
      refusal.hidden = true;
      if (Number.isFinite(value)) this.set(name, value);
    };
    slider.addEventListener("input", () => choose(snapped(slider.valueAsNumber, step)));
    const typed = (): void => {
      if ([fitting(this.values[name], FIELD), given(this.values[name])].includes(number.value)) return;
      const read = readNumber(number.value);
      if ("value" in read) choose(read.value);
      else Object.assign(refusal, { hidden: false, textContent: read.why });
    };
    number.addEventListener("change", typed);
    number.addEventListener("keydown", (event) => event.key === "Enter" && typed());
    number.addEventListener("focus", () => (number.value = given(this.values[name])));
    number.addEventListener("blur", () => this.write(number, this.values[name]));
    reset.addEventListener("click", () => choose(this.base[name]));
    return { parameter, element, slider, number, reset, mark, refusal };
  }
}

/** A multiple of a step without the noise of floating point. */
function snapped(value: number, step: number): number {
  return Number(value.toFixed(decimalsOf(step)));
}

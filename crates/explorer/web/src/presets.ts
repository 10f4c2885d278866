/** The presets as chips, one click each, and the selector of the model. */

import { byId, make } from "./dom";
import type { Registry } from "./protocol";

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
    this.select.replaceChildren(...models.map(({ name, title }) => make("option", { value: name, title }, name)));
  }

  /** Shows which ones are in use. */
  show(model: string, preset: string | null): void {
    this.select.value = model;
    for (const chip of this.place.querySelectorAll<HTMLElement>(".chip")) {
      const chosen = chip.dataset.preset === preset;
      if (chosen && chip.getAttribute("aria-pressed") !== "true") chip.scrollIntoView({ block: "nearest", inline: "nearest" });
      chip.setAttribute("aria-pressed", String(chosen));
    }
  }
}

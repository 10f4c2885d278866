/** The two selectors of the map's axes. */

import { byId, make } from "../dom";
import type { Model, Plane } from "../protocol";
import { symbolOption } from "../symbols";
import { fullAxis } from "./plane";
import { side, starts } from "./sides";

export class AxisSelectors {
  private readonly x = byId<HTMLSelectElement>("x-axis");
  private readonly y = byId<HTMLSelectElement>("y-axis");
  private model: Model | null = null;
  private plane: Plane | null = null;

  constructor(private readonly choose: (plane: Plane) => void) {
    this.x.addEventListener("change", () => this.changed("x"));
    this.y.addEventListener("change", () => this.changed("y"));
  }

  /** Shows the axes of the plane; the options change with the model only. */
  show(model: Model, plane: Plane): void {
    if (model !== this.model) {
      const options = (): HTMLElement[] => [
        ...model.parameters.map(symbolOption),
        make("optgroup", { label: "start of the body (basins)" }, ...starts(model).map(({ name, meaning }) => make("option", { value: name, title: meaning }, `${name}(0)`))),
      ];
      this.x.replaceChildren(...options());
      this.y.replaceChildren(make("option", { value: "", title: "the largest Lyapunov exponent \u03bb\u2081 along one axis" }, "none"), ...options());
      this.model = model;
    }
    this.plane = plane;
    this.x.value = plane.x.name;
    this.y.value = plane.y?.name ?? "";
  }

  /** The other axis keeps its window; where both would be the same they change places. */
  private changed(which: "x" | "y"): void {
    const { model, plane } = this;
    if (!model || !plane) return;
    const axis = (name: string) => {
      const found = side(model, name);
      return found ? fullAxis(found) : null;
    };
    const { x, y } = plane;
    const [name, other] = which === "x" ? [this.x.value, y] : [this.y.value, x];
    if (name === other?.name) this.choose(y ? { x: y, y: x } : plane);
    else if (which === "x") this.choose({ x: axis(name) ?? x, y });
    else this.choose({ x, y: axis(name) });
  }
}


/** A few lines beside a point of a branch. */

const GAP = 12;

export class Tip {
  constructor(private readonly element: HTMLElement) {}

  /** Shows these lines beside a pixel of the canvas, within it. */
  show(lines: HTMLElement[], [x, y]: [number, number]): void {
    const { element } = this;
    element.replaceChildren(...lines);
    element.hidden = false;
    const { clientWidth: width, clientHeight: height } = element.parentElement ?? element;
    const within = (place: number, size: number, whole: number): number => Math.min(Math.max(0, place), whole - size);
    const { offsetWidth: w, offsetHeight: h } = element;
    const beside = [x + GAP, x - GAP - w].find((left) => left >= 0 && left + w <= width);
    // where neither side has room, above or below
    const [left, top] = beside === undefined ? [within(x - w / 2, w, width), y + GAP + h <= height ? y + GAP : y - GAP - h] : [beside, within(y - h / 2, h, height)];
    element.style.translate = `${left}px ${top}px`;
  }

  hide(): void {
    this.element.hidden = true;
  }
}

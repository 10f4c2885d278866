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
    const right = x + GAP + element.offsetWidth <= width;
    const left = right ? x + GAP : Math.max(0, x - GAP - element.offsetWidth);
    const top = Math.min(Math.max(0, y - element.offsetHeight / 2), height - element.offsetHeight);
    element.style.translate = `${left}px ${top}px`;
  }

  hide(): void {
    this.element.hidden = true;
  }
}

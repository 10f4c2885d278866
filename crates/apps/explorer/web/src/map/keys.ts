/** The map by keys: arrows walk, plus and minus zoom, 0 and Home reset. */

export interface KeyActions {
  /** By so many cells. */
  walk(columns: number, rows: number): void;
  zoom(factor: number): void;
  reset(): void;
}

const STEPS: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
const ZOOMS: Record<string, number> = { "+": 1.25, "=": 1.25, "-": 0.8, "\u2212": 0.8 };
/** With Shift. */
const FAR = 8;

export function listenToKeys(canvas: HTMLCanvasElement, actions: KeyActions): void {
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = STEPS[event.key];
    const far = event.shiftKey ? FAR : 1;
    if (step) actions.walk(step[0] * far, step[1] * far);
    else if (event.key in ZOOMS) actions.zoom(ZOOMS[event.key]);
    else if (event.key === "0" || event.key === "Home") actions.reset();
    else return;
    event.preventDefault();
  });
}

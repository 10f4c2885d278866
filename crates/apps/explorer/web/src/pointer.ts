/** Mouse, pen and fingers on a canvas: click, hover, drag, wheel and pinch, in CSS pixels of the canvas. */

/** Something in the hand. */
export interface Held {
  move(at: [number, number]): void;
  drop(): void;
}

export interface Gestures {
  /** What is taken up here, by a finger or not; `null`: nothing. */
  grab?(at: [number, number], touch: boolean): Held | null;
  click?(x: number, y: number): void;
  double?(): void;
  /** The pointer is here; `null` where it left. */
  hover?(at: [number, number] | null): void;
  pan(dx: number, dy: number): void;
  zoom(factor: number, x: number, y: number): void;
}

/** A press that moves less than this is a click. */
const SLACK = 5;

export function watch(canvas: HTMLCanvasElement, gestures: Gestures): void {
  const fingers = new Map<number, [number, number]>();
  let moved = 0;
  /** A finger that moves upwards or downwards first scrolls the page: that is no drag. */
  let scrolls: boolean | null = null;
  let start: [number, number] = [0, 0];
  let held: Held | null = null;
  const place = (event: MouseEvent): [number, number] => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    if (fingers.size === 0) {
      moved = 0;
      start = place(event);
      scrolls = event.pointerType === "touch" && getComputedStyle(canvas).touchAction === "pan-y" ? null : false;
      held = gestures.grab?.(start, event.pointerType === "touch") ?? null;
    }
    fingers.set(event.pointerId, place(event));
    gestures.hover?.(place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event);
    const before = fingers.get(event.pointerId);
    gestures.hover?.(at);
    if (!before) return;
    if (held) {
      fingers.set(event.pointerId, at);
      return held.move(at);
    }
    moved += Math.hypot(at[0] - before[0], at[1] - before[1]);
    if (scrolls === null && moved > SLACK) scrolls = Math.abs(at[1] - start[1]) > Math.abs(at[0] - start[0]);
    if (fingers.size === 1 && moved > SLACK && scrolls === false) gestures.pan(at[0] - before[0], at[1] - before[1]);
    if (fingers.size === 2) pinch(fingers, event.pointerId, before, at, gestures);
    fingers.set(event.pointerId, at);
  });
  const lift = (event: PointerEvent, clicked: boolean): void => {
    const [x, y] = place(event);
    if (held && fingers.delete(event.pointerId)) {
      held.drop();
      held = null;
      return;
    }
    if (fingers.delete(event.pointerId) && clicked && moved <= SLACK && fingers.size === 0) gestures.click?.(x, y);
  };
  canvas.addEventListener("pointerup", (event) => lift(event, true));
  canvas.addEventListener("pointercancel", (event) => lift(event, false));
  canvas.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && gestures.hover?.(null));
  // What is in the hand does not scroll the page.
  canvas.addEventListener("touchstart", (event) => held && event.preventDefault(), { passive: false });
  canvas.addEventListener("dblclick", () => gestures.double?.());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    gestures.zoom(Math.exp(-Math.max(-200, Math.min(200, event.deltaY * lines)) * 0.0022), ...place(event));
  }, { passive: false });
}

/** Two fingers: the distance zooms about their middle, the middle pans. */
function pinch(fingers: Map<number, [number, number]>, id: number, before: [number, number], at: [number, number], gestures: Gestures): void {
  for (const [other, still] of fingers) {
    if (other === id) continue;
    const distance = (p: [number, number]): number => Math.max(1, Math.hypot(p[0] - still[0], p[1] - still[1]));
    gestures.pan((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
    gestures.zoom(distance(at) / distance(before), (at[0] + still[0]) / 2, (at[1] + still[1]) / 2);
  }
}

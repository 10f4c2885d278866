/** Mouse, pen and fingers on a canvas: click, hover, drag, wheel and pinch, in CSS pixels of the canvas. */

export interface Gestures {
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
  const place = (event: MouseEvent): [number, number] => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    if (fingers.size === 0) moved = 0;
    fingers.set(event.pointerId, place(event));
    gestures.hover?.(place(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event);
    const before = fingers.get(event.pointerId);
    gestures.hover?.(at);
    if (!before) return;
    moved += Math.hypot(at[0] - before[0], at[1] - before[1]);
    if (fingers.size === 1 && moved > SLACK) gestures.pan(at[0] - before[0], at[1] - before[1]);
    if (fingers.size === 2) pinch(fingers, event.pointerId, before, at, gestures);
    fingers.set(event.pointerId, at);
  });
  const lift = (event: PointerEvent, clicked: boolean): void => {
    const [x, y] = place(event);
    if (fingers.delete(event.pointerId) && clicked && moved <= SLACK && fingers.size === 0) gestures.click?.(x, y);
  };
  canvas.addEventListener("pointerup", (event) => lift(event, true));
  canvas.addEventListener("pointercancel", (event) => lift(event, false));
  canvas.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && gestures.hover?.(null));
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

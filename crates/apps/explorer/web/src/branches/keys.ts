/** The diagram by keys: arrows walk along a branch and between branches, Page keys go to special points, Enter takes the body there. */

export interface BranchKeys {
  walk(points: number): void;
  turn(branches: number): void;
  special(by: number): void;
  take(): void;
}

const FAR = 10;

export function listenToBranchKeys(canvas: HTMLCanvasElement, keys: BranchKeys): void {
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const far = event.shiftKey ? FAR : 1;
    const acts: Record<string, () => void> = {
      ArrowLeft: () => keys.walk(-far),
      ArrowRight: () => keys.walk(far),
      ArrowDown: () => keys.turn(1),
      ArrowUp: () => keys.turn(-1),
      PageDown: () => keys.special(1),
      PageUp: () => keys.special(-1),
      Enter: () => keys.take(),
    };
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  });
}

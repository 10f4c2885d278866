/** The hand by keys, for those who use no pointer: the body is put elsewhere, thrown, and its outline pulled. */

import { extent, put, type GrabHost } from "./grab";

const STEPS: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
/** The body is put so many pixels further. */
const FAR = 16;
/** The outline is pulled to so many times its distance from the centre: in front, and with Shift at the side. */
const PULLS: Record<string, { part: number; side: boolean }> = {
  o: { part: 1.1, side: false },
  i: { part: 0.9, side: false },
  O: { part: 1.1, side: true },
  I: { part: 0.9, side: true },
};

/** Listens while the picture of the body has the focus; `heading` is the direction of motion. */
export function listenToKeys(canvas: HTMLCanvasElement, host: GrabHost, heading: () => number): void {
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !host.frame()) return;
    const [step, pull] = [STEPS[event.key], PULLS[event.key]];
    if (!step && !pull) return;
    event.preventDefault();
    event.stopPropagation();
    host.hold(true);
    if (pull) pullTo(host, heading() + (pull.side ? Math.PI / 2 : 0), pull.part);
    else if (event.shiftKey) throwTowards(host, step);
    else carry(host, step);
    host.hold(false);
  });
}

function carry(host: GrabHost, [u, v]: [number, number]): void {
  const frame = host.frame();
  const far = FAR / host.camera.scale;
  if (frame) host.wish(put([frame.x + u * far, frame.y + v * far], null), true);
}

/** As fast as it has been of late, or a radius per time. */
function throwTowards(host: GrabHost, [u, v]: [number, number]): void {
  const frame = host.frame();
  if (!frame) return;
  const speed = Math.max(host.fastest(), frame.radius);
  host.wish(put([frame.x, frame.y], [u * speed, v * speed]), true);
}

function pullTo(host: GrabHost, angle: number, part: number): void {
  const frame = host.frame();
  if (!frame) return;
  const distance = (part * extent(host, frame, angle)) / (host.camera.scale * host.enlarged());
  host.wish({ do: "pull", state: [...frame.state], to: [distance * Math.cos(angle), distance * Math.sin(angle)] }, true);
}

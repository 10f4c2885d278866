/** The parts of the body's picture but for its path: grid and scale bar, outline, direction of motion. */

import type { Frame } from "../binary";
import { SPEED, X, Y, type History } from "../history";
import { UI_FONT } from "../plot";
import { pretty, roundStep } from "../numbers";
import type { Inks } from "../theme";
import type { Camera } from "./camera";

/** What is drawn. */
export interface BodyScene {
  camera: Camera;
  history: History;
  /** First sample of the trail. */
  from: number;
  frame: Frame;
  /** The last outline that was a curve; `null` while there was none. */
  outline: Float64Array | null;
  /** How much larger than true the body is drawn. */
  enlarged: number;
  /** Of the inside. */
  colour: string;
  /** Of edge and trail. */
  edge: string;
  /** The sample that the cursor in the time series points at; -1: none. */
  pointed: number;
}

/** The body and what belongs to it; the rest is its backdrop. */
export function paintBody(g: CanvasRenderingContext2D, scene: BodyScene, inks: Inks): void {
  const { camera, history } = scene;
  paintOutline(g, scene);
  paintArrow(g, scene, inks);
  if (scene.pointed >= 0) dot(g, camera, history.at(scene.pointed, X), history.at(scene.pointed, Y), inks);
}

/** Squares of a round size. */
export function paintGrid(g: CanvasRenderingContext2D, camera: Camera, inks: Inks): void {
  const step = roundStep(130 / camera.scale);
  g.strokeStyle = inks.faint;
  g.lineWidth = 1;
  g.beginPath();
  const left = camera.x - camera.width / 2 / camera.scale;
  const bottom = camera.y - camera.height / 2 / camera.scale;
  for (let x = Math.ceil(left / step) * step; camera.toX(x) < camera.width; x += step) {
    const u = Math.round(camera.toX(x)) + 0.5;
    g.moveTo(u, 0);
    g.lineTo(u, camera.height);
  }
  for (let y = Math.ceil(bottom / step) * step; camera.toY(y) > 0; y += step) {
    const v = Math.round(camera.toY(y)) + 0.5;
    g.moveTo(0, v);
    g.lineTo(camera.width, v);
  }
  g.stroke();
}

function paintOutline(g: CanvasRenderingContext2D, { camera, frame, outline, enlarged, colour, edge }: BodyScene): void {
  if (!outline || outline.length < 6) return;
  const size = camera.scale * enlarged;
  const [x, y] = [camera.toX(frame.x), camera.toY(frame.y)];
  g.beginPath();
  for (let i = 0; i < outline.length; i += 2) g.lineTo(x + size * outline[i], y - size * outline[i + 1]);
  g.closePath();
  g.fillStyle = colour;
  g.globalAlpha = frame.outlined ? 0.28 : 0.06;
  g.fill();
  g.globalAlpha = 1;
  g.strokeStyle = edge;
  g.lineWidth = 2;
  g.lineJoin = "round";
  if (!frame.outlined) g.setLineDash([5, 4]);
  g.stroke();
  g.setLineDash([]);
}

/** An arrow along the velocity; its length is the speed relative to the largest speed of late. */
function paintArrow(g: CanvasRenderingContext2D, { camera, frame, history, from, enlarged }: BodyScene, inks: Inks): void {
  const last = history.length - 1;
  if (last < 1) return;
  const [dx, dy] = [history.at(last, X) - history.at(last - 1, X), history.at(last, Y) - history.at(last - 1, Y)];
  const distance = Math.hypot(dx, dy);
  let fastest = 0;
  for (let i = from; i <= last; i += 8) fastest = Math.max(fastest, history.at(i, SPEED));
  const share = history.at(last, SPEED) / Math.max(fastest, 1e-6);
  if (!(distance > 0) || !(share > 0.02)) return;
  const length = frame.radius * enlarged * camera.scale * (0.25 + 0.6 * Math.min(1, share));
  const [ux, uy] = [dx / distance, -dy / distance];
  const [x, y] = [camera.toX(frame.x), camera.toY(frame.y)];
  const head = Math.min(7, 0.45 * length);
  const [tx, ty] = [x + ux * length, y + uy * length];
  g.strokeStyle = g.fillStyle = inks.ink;
  g.lineWidth = 1.5;
  g.beginPath();
  g.moveTo(x, y);
  g.lineTo(tx - ux * head, ty - uy * head);
  g.stroke();
  g.beginPath();
  g.moveTo(tx, ty);
  g.lineTo(tx - ux * head - uy * head * 0.5, ty - uy * head + ux * head * 0.5);
  g.lineTo(tx - ux * head + uy * head * 0.5, ty - uy * head - ux * head * 0.5);
  g.fill();
}

function dot(g: CanvasRenderingContext2D, camera: Camera, x: number, y: number, inks: Inks): void {
  g.beginPath();
  g.arc(camera.toX(x), camera.toY(y), 4.5, 0, 2 * Math.PI);
  g.fillStyle = inks.plot;
  g.strokeStyle = inks.ink;
  g.lineWidth = 1.6;
  g.fill();
  g.stroke();
}

/** A bar of a round length, with its length. */
export function paintScale(g: CanvasRenderingContext2D, camera: Camera, inks: Inks): void {
  const length = roundStep(110 / camera.scale);
  const [x, y, width] = [14, camera.height - 14, length * camera.scale];
  g.strokeStyle = g.fillStyle = inks.ink;
  g.lineWidth = 1.5;
  g.beginPath();
  g.moveTo(x, y - 4);
  g.lineTo(x, y);
  g.lineTo(x + width, y);
  g.lineTo(x + width, y - 4);
  g.stroke();
  g.font = `11px ${UI_FONT}`;
  g.textAlign = "left";
  g.textBaseline = "alphabetic";
  const text = `${pretty(length)} ${camera.unit ?? `model length${length === 1 ? "" : "s"}`}`;
  // A ground of its own is cheaper than letters with a halo, and as legible upon the trail.
  g.globalAlpha = 0.75;
  g.fillStyle = inks.plot;
  g.fillRect(x + 3, y - 18, g.measureText(text).width + 4, 14);
  g.globalAlpha = 1;
  g.fillStyle = inks.ink;
  g.fillText(text, x + 5, y - 7);
}

/**
 * What lies behind the body: ground, grid, path, scale. While the camera rests it is drawn ten times a second and copied for each
 * picture, with the newest piece of the path upon it: a long path costs more than everything else.
 */

import type { Sheet } from "../canvas";
import type { Inks } from "../theme";
import { paintInset } from "./inset";
import { paintGrid, paintScale, type BodyScene } from "./painting";
import { paintNewest, paintTrail } from "./trail";

/** Milliseconds after which the copy is too old: the path fades with age. */
const OLD = 100;

export class Backdrop {
  private readonly canvas = document.createElement("canvas");
  private readonly g: CanvasRenderingContext2D | null = this.canvas.getContext("2d", { alpha: false });
  /** What the copy shows: the same words, the same picture but for the newest samples. */
  private shows = "";
  /** Samples of the run that the copy shows. */
  private seen = 0;
  private drawn = -Infinity;

  /** The copy holds no longer. */
  forget(): void {
    this.shows = "";
  }

  /** Paints upon the whole sheet, up to the body. */
  paint(sheet: Sheet, scene: BodyScene, inks: Inks): void {
    const { camera, history, frame, edge } = scene;
    if (!camera.resting || !this.g) {
      sheet.clear(inks.plot);
      this.paintAll(sheet.g, scene, inks);
      this.shows = "";
    } else {
      this.renew(this.g, sheet, scene, inks);
      sheet.g.setTransform(1, 0, 0, 1, 0, 0);
      sheet.g.drawImage(this.canvas, 0, 0);
      sheet.g.setTransform(sheet.ratio, 0, 0, sheet.ratio, 0, 0);
    }
    const first = this.shows ? history.length - 1 - (history.total - this.seen) : history.length - 1;
    paintNewest(sheet.g, camera, history, Math.max(0, first), frame.x, frame.y, edge);
  }

  /** Draws the copy again where it shows something else, or is old. */
  private renew(g: CanvasRenderingContext2D, sheet: Sheet, scene: BodyScene, inks: Inks): void {
    const { camera, history, from, edge, frame } = scene;
    const now = performance.now();
    const { x, y, scale } = camera;
    const shows = [sheet.canvas.width, sheet.canvas.height, sheet.ratio, x, y, scale, edge, inks.plot, frame.revision, frame.radius].join();
    const grown = history.total - this.seen;
    if (shows === this.shows && now - this.drawn < OLD && grown >= 0 && grown < history.length - from) return;
    Object.assign(this, { shows, seen: history.total, drawn: now });
    if (this.canvas.width !== sheet.canvas.width) this.canvas.width = sheet.canvas.width;
    if (this.canvas.height !== sheet.canvas.height) this.canvas.height = sheet.canvas.height;
    g.setTransform(sheet.ratio, 0, 0, sheet.ratio, 0, 0);
    g.fillStyle = inks.plot;
    g.fillRect(0, 0, sheet.width, sheet.height);
    this.paintAll(g, scene, inks);
  }

  private paintAll(g: CanvasRenderingContext2D, { camera, history, from, frame, edge }: BodyScene, inks: Inks): void {
    paintGrid(g, camera, inks);
    paintTrail(g, camera, history, from, edge);
    paintScale(g, camera, inks);
    paintInset(g, camera, history, from, frame.radius, edge, inks);
  }
}

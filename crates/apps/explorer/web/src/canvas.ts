/** A canvas that is as sharp as the screen and as large as its place on the page. */

import { currentInks } from "./theme";

export class Sheet {
  readonly g: CanvasRenderingContext2D;
  width = 0;
  height = 0;
  ratio = 1;

  /** Calls `changed` whenever the size changes; the drawing is then gone. An opaque sheet is cheaper to show: nothing shines through. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    changed: () => void,
    private readonly opaque = false,
  ) {
    const g = canvas.getContext("2d", { alpha: !opaque });
    if (!g) throw new Error("this browser does not support canvas drawing");
    this.g = g;
    new ResizeObserver(() => {
      if (this.fit()) changed();
    }).observe(canvas);
    this.fit();
  }

  /** An empty sheet, of the colour `ground` where it is opaque. Units of drawing are CSS pixels. */
  clear(ground?: string): void {
    this.g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    if (!ground) return this.g.clearRect(0, 0, this.width, this.height);
    this.g.fillStyle = ground;
    this.g.fillRect(0, 0, this.width, this.height);
  }

  private fit(): boolean {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = Math.min(3, window.devicePixelRatio || 1);
    if (width === this.width && height === this.height && ratio === this.ratio) return false;
    Object.assign(this, { width, height, ratio });
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    // An opaque canvas is black until something is drawn.
    if (this.opaque) this.clear(currentInks().plot);
    return true;
  }
}

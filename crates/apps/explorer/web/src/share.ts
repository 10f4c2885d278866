/** Share and keep: links, commands, Python, and files of data and figures. */

import type { File } from "./binary";
import { copy } from "./clipboard";
import { byId, make, setText } from "./dom";
import type { Section, Share, Wish } from "./protocol";
import { png } from "./raster";
import { toast } from "./toasts";

const DATA: [string, string][] = [["study.toml", "Study (TOML)"], ["motion.csv", "Motion (CSV)"], ["map.csv", "Map (CSV)"], ["body.apng", "Animation (APNG)"]];
/** Only a map of one axis has it. */
const EXPONENTS = "map-exponents";
const FIGURES: [string, string][] = [["map", "Map"], [EXPONENTS, "Exponents along the map"], ["path", "Path"], ["series", "Time series"], ["spectrum", "Power spectrum"], ["return-map", "Return map"], ["exponent", "Lyapunov exponents"]];
const FORMATS = ["svg", "png"];

/** What sharing needs of the page. */
export interface ShareHost {
  send(wish: Wish): void;
  connected(): boolean;
  section(): { section: Section; y: number | null };
  /** The address of now. */
  link(): string;
}

export class ShareMenu {
  private next = 1;
  private readonly pending = new Map<number, string>();
  private wanted: "command" | "python" = "command";
  private readonly dialog = byId<HTMLDialogElement>("dialog");

  constructor(private readonly host: ShareHost) {
    this.buildMenu();
    this.buildPanels();
    byId("share-link").addEventListener("click", (event) => void copy(host.link(), event.currentTarget as HTMLButtonElement));
    for (const what of ["command", "python"] as const) {
      byId(`share-${what}`).addEventListener("click", () => {
        this.wanted = what;
        if (this.online()) host.send({ do: "share" });
      });
    }
    byId("dialog-close").addEventListener("click", () => this.dialog.close());
    byId("dialog-copy").addEventListener("click", (event) => void copy(byId("dialog-text").textContent ?? "", event.currentTarget as HTMLButtonElement));
    closeMenusOutside();
  }

  /** Whether the map has one axis only. */
  showStrip(strip: boolean): void {
    for (const part of document.querySelectorAll<HTMLElement>(`[data-figure-of="${EXPONENTS}"]`)) part.hidden = !strip;
  }

  /** Shows the text that was asked for. */
  show(share: Share): void {
    setText(byId("dialog-title"), this.wanted === "command" ? "Equivalent command" : "Equivalent Python code");
    setText(byId("dialog-text"), share[this.wanted]);
    if (!this.dialog.open) this.dialog.showModal();
  }

  /** Hands a file over to the reader. A drawing that was requested as PNG is made one here. */
  async take(file: File): Promise<void> {
    let { blob } = file;
    try {
      if (file.name.endsWith(".png") && blob.type === "image/svg+xml") blob = await png(blob);
    } catch (error) {
      this.refuse(file.id, String(error));
      return;
    }
    this.pending.delete(file.id);
    this.state();
    const link = make("a", { href: URL.createObjectURL(blob), download: file.name });
    document.body.append(link);
    link.click();
    link.remove();
    window.setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  }

  /** A file that cannot be made; tells whether it was one of ours. */
  refuse(id: number, why: string): boolean {
    const what = this.pending.get(id);
    if (what === undefined) return false;
    this.pending.delete(id);
    this.state();
    toast(`${what}: ${why}`);
    return true;
  }

  /** The connection broke: nothing that was asked for will come. */
  drop(): void {
    this.pending.clear();
    this.state();
  }

  private export(what: string): void {
    if (!this.online()) return;
    const id = this.next++;
    this.pending.set(id, what);
    this.state();
    this.host.send({ do: "export", id, what, ...this.host.section() });
  }

  private online(): boolean {
    if (!this.host.connected()) toast("Not connected: this requires the server.");
    return this.host.connected();
  }

  private state(): void {
    const names = [...this.pending.values()];
    setText(byId("export-state"), names.length ? `creating ${names.join(", ")}\u2026` : "");
    document.documentElement.toggleAttribute("data-busy", names.length > 0);
  }

  private button(what: string, text: string, attribute: string): HTMLButtonElement {
    const button = make("button", { type: "button", [attribute]: what, title: `Save ${what}` }, text);
    button.addEventListener("click", () => this.export(what));
    return button;
  }

  private buildMenu(): void {
    byId("export-data").append(...DATA.map(([what, text]) => this.button(what, text, "data-export")));
    for (const [figure, text] of FIGURES) {
      const row = [make("span", {}, text), ...FORMATS.map((format) => this.button(`${figure}.${format}`, format.toUpperCase(), "data-export"))];
      for (const part of row) part.dataset.figureOf = figure;
      byId("export-figures").append(...row);
    }
  }

  /** The small save menus of the panels. */
  private buildPanels(): void {
    for (const menu of document.querySelectorAll<HTMLDetailsElement>("details.save")) {
      const figure = menu.dataset.figure ?? "";
      const also = figure === "map" ? ["map.csv"] : figure === "path" ? ["body.apng", "motion.csv"] : [];
      const files = [...FORMATS.map((format) => `${figure}.${format}`), ...also];
      const buttons = files.map((what) => this.button(what, (what.split(".").pop() ?? "").toUpperCase(), "data-save"));
      if (figure === "map") {
        for (const format of FORMATS) {
          const button = this.button(`${EXPONENTS}.${format}`, `\u03bb\u2081 ${format.toUpperCase()}`, "data-save");
          button.dataset.figureOf = EXPONENTS;
          buttons.push(button);
        }
      }
      menu.append(make("summary", { title: "Save this figure", "aria-label": "Save this figure" }, arrow()), make("div", { class: "menu-body" }, ...buttons));
      menu.addEventListener("click", (event) => event.target instanceof HTMLButtonElement && (menu.open = false));
    }
  }
}

/** An arrow down onto a line. */
function arrow(): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  for (const [name, value] of Object.entries({ viewBox: "0 0 16 16", width: "14", height: "14", "aria-hidden": "true" })) svg.setAttribute(name, value);
  for (const [name, value] of Object.entries({ d: "M8 2v8M4.500 6.800 8 10.300 11.500 6.800M3 13.500h10", fill: "none", stroke: "currentColor", "stroke-width": "1.600" })) path.setAttribute(name, value);
  svg.append(path);
  return svg;
}

/** Menus close by a click elsewhere and by Escape. */
function closeMenusOutside(): void {
  const close = (keep: Node | null): void => {
    for (const menu of document.querySelectorAll<HTMLDetailsElement>("details.menu[open]")) if (!keep || !menu.contains(keep)) menu.open = false;
  };
  document.addEventListener("pointerdown", (event) => close(event.target as Node));
  document.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    const open = document.querySelector<HTMLDetailsElement>("details.menu[open]");
    if (open?.contains(document.activeElement)) open.querySelector("summary")?.focus();
    close(null);
  });
}

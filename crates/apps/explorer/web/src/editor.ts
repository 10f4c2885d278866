/** The editor of equations: a study file as text; a mistake is marked at its place. */

import { byId, setText } from "./dom";
import type { Mistake, Model, Wish } from "./protocol";
import { keep, recall } from "./stored";

/** Where the text is kept while the tab of the browser is open. */
export const KEPT = "motiform.equations";

/** What the editor needs of the page. */
export interface EditorHost {
  send(wish: Wish): void;
  /** Bytes of the longest message. */
  longest(): number;
  /** The text has become this model: run it. */
  run(model: Model): void;
}

export class Editor {
  private readonly dialog = byId<HTMLDialogElement>("editor");
  private readonly area = byId<HTMLTextAreaElement>("editor-text");
  private readonly mistake = byId("editor-mistake");
  /** What hears the answer to a definition. */
  private waiting: ((model: Model | null) => void) | null = null;

  constructor(private readonly host: EditorHost) {
    byId("editor-run").addEventListener("click", () => this.define());
    byId("editor-close").addEventListener("click", () => this.dialog.close());
    this.area.addEventListener("input", () => (this.mistake.hidden = true));
    this.dialog.addEventListener("keydown", (event) => {
      event.stopPropagation(); // the page's keys are letters here
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) this.define();
    });
  }

  /** The text of the present study, which was asked for. */
  open(text: string): void {
    this.area.value = text;
    this.mistake.hidden = true;
    if (!this.dialog.open) this.dialog.showModal();
    this.area.focus();
    this.area.setSelectionRange(0, 0);
    this.area.scrollTop = 0;
  }

  /** Gives the server the text that this tab has kept; `then` hears its model, or `null` where there is none. */
  restore(then: (model: Model | null) => void): void {
    const text = recall("sessionStorage", KEPT);
    if (text === null || this.excess(text)) return then(null);
    this.waiting = then;
    this.host.send({ do: "define", text });
  }

  private define(): void {
    const excess = this.excess(this.area.value);
    if (excess) return this.complain(excess);
    this.waiting = (model) => {
      if (!model) return;
      keep("sessionStorage", KEPT, this.area.value);
      this.dialog.close();
      this.host.run(model);
    };
    this.host.send({ do: "define", text: this.area.value });
  }

  /** Why a text cannot be sent: a longer message ends the connection. Empty for one that can. */
  private excess(text: string): string {
    const { length } = new TextEncoder().encode(JSON.stringify({ do: "define", text } satisfies Wish));
    const longest = this.host.longest();
    if (length <= longest) return "";
    return `This study is too long to be sent: ${Math.ceil(length / 1024)} kB of at most ${longest / 1024} kB. Shorten it, or save it as a file and open it with: motiform explore FILE`;
  }

  private complain(problem: string): void {
    setText(this.mistake, problem);
    this.mistake.hidden = false;
  }

  defined(model: Model): void {
    this.answered(model);
  }

  /** Shows a mistake below the text and selects its place. */
  mistaken({ line, column, length, problem }: Mistake): void {
    if (this.dialog.open) {
      this.complain(`Line ${line}, column ${column}: ${problem}`);
      const start = offset(this.area.value, line, column);
      this.area.focus();
      this.area.setSelectionRange(start, Math.min(start + length, this.area.value.length));
      this.area.scrollTop = Math.max(0, line - 6) * parseFloat(getComputedStyle(this.area).lineHeight);
    }
    this.answered(null);
  }

  private answered(model: Model | null): void {
    const waiting = this.waiting;
    this.waiting = null;
    waiting?.(model);
  }
}

/** The place of a line and a column, both from 1; columns count characters, not units of UTF-16. */
function offset(text: string, line: number, column: number): number {
  const lines = text.split("\n");
  const before = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
  return before + [...(lines[line - 1] ?? "")].slice(0, column - 1).join("").length;
}

/** Words of the verdicts that have a definition: shown while one points at them, has them in focus, or taps them. */

import { byId, make, setText } from "./dom";

const MULTIPLIER = "factor by which a small deviation from a periodic orbit grows in one period, or in half of it for a motion that is then its own mirror image; stable if all are below 1 in size";

/** As in docs/glossary.md. */
const MEANINGS: Record<string, string> = {
  multiplier: MULTIPLIER,
  multipliers: MULTIPLIER,
  section: "a surface in the space of shapes at which the crossings of an orbit are located; here, where a shape returns to it",
  margin: "distance of the deciding quantity from its threshold, in units of its own uncertainty: larger is more certain",
  eigenvalue: "growth rate of a small deviation from a fixed shape (inverse time); stable if all are negative",
  saddles: "fixed shapes that attract in some directions and repel in others",
  "heteroclinic cycle": "an orbit that visits saddles in turn and rests near each",
  "0-1 test": "a number near 1 for chaos and near 0 for ordered motion, computed from the returns",
  torus: "a motion with two frequencies in irrational ratio",
  dimension: "of the set of returns: 0 for points, 1 for a closed curve",
  transient: "motion that does not persist",
  "net rotation": "angle by which the shape has turned after one period of its motion",
  "\u03bb\u2081": "largest Lyapunov exponent: mean exponential growth rate of a small deviation (inverse time)",
  "\u03bb\u208a": "rate at which an orbit leaves the saddle",
  "\u03bb\u208b": "rate at which an orbit approaches the saddle",
  "t*": "time at which the shape becomes infinite",
};

const WORDS = new RegExp(`(${Object.keys(MEANINGS).sort((a, b) => b.length - a.length).map((word) => word.replace(/[*]/g, "\\$&")).map((word) => (/^\w/.test(word) && /\w$/.test(word) ? `\\b${word}\\b` : word)).join("|")})`);

/** Sets a sentence, with its defined words marked; nothing is touched where it is shown already. */
export function explained(element: HTMLElement, text: string): void {
  if (element.dataset.text === text) return;
  element.dataset.text = text;
  element.title = text;
  element.replaceChildren(...text.split(WORDS).map((part) => (part in MEANINGS ? make("dfn", { tabindex: "0", "data-meaning": MEANINGS[part] }, part) : part)));
}

const GAP = 6;

/** Shows the definition below its word, within the page. */
function show(word: HTMLElement): void {
  const tip = byId("definition");
  setText(tip, word.dataset.meaning ?? "");
  tip.hidden = false;
  word.setAttribute("aria-describedby", tip.id);
  const box = word.getBoundingClientRect();
  const left = Math.max(GAP, Math.min(box.left, document.documentElement.clientWidth - tip.offsetWidth - GAP));
  const below = box.bottom + GAP;
  const top = below + tip.offsetHeight <= window.innerHeight ? below : box.top - GAP - tip.offsetHeight;
  tip.style.translate = `${left}px ${top}px`;
}

/** Listens for the whole page. */
export function startDefinitions(): void {
  const word = (event: Event): HTMLElement | null => (event.target instanceof Element ? event.target.closest<HTMLElement>("dfn[data-meaning]") : null);
  const hide = (): void => void (byId("definition").hidden = true);
  for (const kind of ["pointerover", "focusin", "click"]) {
    document.addEventListener(kind, (event) => {
      const found = word(event);
      if (found) show(found);
      else if (kind !== "focusin") hide();
    });
  }
  document.addEventListener("focusout", hide);
  document.addEventListener("scroll", hide, true);
  document.addEventListener("keydown", (event) => event.key === "Escape" && hide());
}

/** The name of the motion above the body, and the sentence that says why. */

import { byId, setText } from "../dom";
import { swatch } from "../glyphs";
import type { Regime } from "../protocol";

export const NAMING = "classifying\u2026";
/** A name is spoken once it has stood this long. */
const SPOKEN_AFTER = 1200;

let timer = 0;

/** Shows the name; without a regime the motion is being named. */
export function showName(regime: Regime | null, why: string): void {
  const label = byId("regime");
  const name = regime?.name ?? NAMING;
  if (label.dataset.regime !== (regime?.name ?? "") || label.textContent !== name) {
    setText(label, name);
    label.dataset.regime = regime?.name ?? "";
    label.title = regime?.meaning ?? "";
    byId("regime-glyph").replaceChildren(swatch(regime, 26));
  }
  const sentence = byId("why");
  setText(sentence, why);
  sentence.title = why;
  window.clearTimeout(timer);
  if (regime) timer = window.setTimeout(() => setText(byId("spoken"), `${regime.name}: ${why}`), SPOKEN_AFTER);
}

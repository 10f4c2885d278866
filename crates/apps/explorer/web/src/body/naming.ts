/** The name of the motion above the body, and the sentence that says why. */

import { byId, setText } from "../dom";
import { explained } from "../terms";
import { swatch } from "../glyphs";
import type { Regime } from "../protocol";

export const NAMING = "classifying\u2026";
/** A name is spoken once it has stood this long. */
const SPOKEN_AFTER = 1200;

let timer = 0;

/** A sentence that is longer than its place ends with an ellipsis, until one asks for all of it. */
export function startWhy(): void {
  const [box, why, more] = [byId("why-box"), byId("why"), byId("why-more")];
  const open = (whole: boolean): void => {
    box.toggleAttribute("data-open", whole);
    more.setAttribute("aria-expanded", String(whole));
    setText(more, whole ? "less" : "more");
  };
  const fit = (): void => {
    if (box.hasAttribute("data-open")) return;
    const long = why.scrollHeight > why.clientHeight + 1;
    box.toggleAttribute("data-long", long);
    more.hidden = !long;
  };
  more.addEventListener("click", () => open(!box.hasAttribute("data-open")));
  why.addEventListener("focusin", () => more.hidden || open(true));
  new MutationObserver(() => {
    open(false);
    fit();
  }).observe(why, { childList: true });
  new ResizeObserver(() => fit()).observe(box);
}

/** Shows the name; without a regime the motion is being named, and `likely` is what the map has at these parameters. */
export function showName(regime: Regime | null, why: string, likely: Regime | null = null): void {
  const label = byId("regime");
  const name = regime?.words ?? likely?.words ?? NAMING;
  if (label.dataset.regime !== (regime?.name ?? "") || label.textContent !== name) {
    setText(label, name);
    label.dataset.regime = regime?.name ?? "";
    label.title = (regime ?? likely)?.meaning ?? "";
    byId("regime-glyph").replaceChildren(swatch(regime ?? likely, 26));
  }
  explained(byId("why"), regime || !likely ? why : "as the map has it here, from the start of the preset; the motion of this body is being classified\u2026");
  window.clearTimeout(timer);
  if (regime) timer = window.setTimeout(() => setText(byId("spoken"), `${regime.words}: ${why}`), SPOKEN_AFTER);
}

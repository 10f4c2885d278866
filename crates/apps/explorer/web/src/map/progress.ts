/** How far the map is, in a line of fixed height. */

import { byId, setText } from "../dom";
import { duration, pretty } from "../numbers";
import type { Mapped, Progress } from "../protocol";

export function showProgress({ done, total, rate }: Pick<Progress, "done" | "total" | "rate">): void {
  const left = rate > 0 ? `, ${pretty(rate, 2)}/s, ${duration((total - done) / rate)} left` : "";
  say(`${grouped(done)} of ${grouped(total)} cells${left}`, total > 0 ? done / total : 0);
}

/** Cells that were known already are not counted as computed. */
export function showMapped({ cells, computed, seconds }: Mapped): void {
  const time = `${seconds < 0.1 ? "less than 0.1" : pretty(seconds, 2)} s`;
  if (computed === cells) say(`${grouped(cells)} cells in ${time}`, 1);
  else if (computed === 0) say(`${grouped(cells)} cells, known before`, 1);
  else say(`${grouped(cells)} cells, ${grouped(computed)} computed in ${time}`, 1);
}

function say(text: string, fraction: number): void {
  setText(byId("map-progress-text"), text);
  byId<HTMLProgressElement>("map-progress-bar").value = fraction;
}

function grouped(count: number): string {
  return String(Math.round(count)).replace(/\B(?=(\d{3})+$)/g, "\u2009");
}

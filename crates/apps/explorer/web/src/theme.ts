/** Light and dark: the system's choice until the reader chooses; the colours of canvases come from the style sheet. */

import { keep, recall } from "./stored";

const KEY = "motiform-theme";

/** Colours for canvases, as the style sheet has them now. */
export interface Inks {
  dark: boolean;
  ink: string;
  muted: string;
  faint: string;
  line: string;
  ground: string;
  plot: string;
}

/** Colours of curves (Okabe and Ito 2008), in the order in which curves take them. */
export const CURVES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const CURVES_ON_DARK = ["#56b4e9", "#e69f00", "#2bbd92", "#e39bc6", "#ff8a3d", "#8aa4ff"];

/** Dashes of curves: they stay apart without colour. */
export const DASHES: number[][] = [[], [6, 3], [2, 2.5], [8, 3, 2, 3], [12, 4], [4, 4]];

const dark = matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set<() => void>();
let inks: Inks = read();

/** The colours of now. */
export function currentInks(): Inks {
  return inks;
}

/** Colour of the curve with this number. */
export function curve(index: number): string {
  const colours = inks.dark ? CURVES_ON_DARK : CURVES;
  return colours[index % colours.length];
}

/** The colour of a regime upon the ground: black would be invisible upon dark. */
export function visible(colour: string): string {
  return inks.dark && colour === "#000000" ? inks.ink : colour;
}

/** A colour for edges and lines, moved away from the ground so that it stands out. */
export function edge(colour: string): string {
  const toward = inks.dark ? 255 : 0;
  const share = inks.dark ? 0.25 : 0.3;
  const channels = [1, 3, 5].map((at) => Math.round(parseInt(colour.slice(at, at + 2), 16) * (1 - share) + toward * share));
  return `rgb(${channels.join(" ")})`;
}

/** Calls back after each change of the theme, until what it returns is called. */
export function onTheme(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** Wires the button and follows the system. */
export function startTheme(button: HTMLButtonElement): void {
  const chosen = recall("localStorage", KEY);
  if (chosen) document.documentElement.dataset.theme = chosen;
  dark.addEventListener("change", () => apply(button));
  button.addEventListener("click", () => {
    const next = read().dark ? "light" : "dark";
    document.documentElement.dataset.theme = next;
    keep("localStorage", KEY, next);
    apply(button);
  });
  apply(button);
}

function apply(button: HTMLButtonElement): void {
  inks = read();
  button.setAttribute("aria-label", inks.dark ? "Light theme" : "Dark theme");
  button.title = inks.dark ? "Light theme" : "Dark theme";
  for (const listener of listeners) listener();
}

/** The colours as the browser resolves them. */
function read(): Inks {
  const probe = document.createElement("i");
  probe.hidden = true;
  document.documentElement.append(probe);
  const channels = (name: string): number[] => {
    probe.style.color = `var(--${name})`;
    return (getComputedStyle(probe).color.match(/\d+/g) ?? []).slice(0, 3).map(Number);
  };
  const colour = (name: string): string => `#${channels(name).map((one) => one.toString(16).padStart(2, "0")).join("")}`;
  const inks = {
    dark: Math.max(...channels("paper")) < 128,
    ink: colour("ink"),
    muted: colour("muted"),
    faint: colour("faint"),
    line: colour("line"),
    ground: colour("paper"),
    plot: colour("plot"),
  };
  probe.remove();
  return inks;
}

/** Fields for numbers: what was typed is read here, not by the browser, which drops characters in silence. */

import { plain } from "./numbers";

/** A number, or what is wrong with the text. */
export type Typed = { value: number } | { why: string };

/** Reads what was typed. */
export function readNumber(text: string): Typed {
  const typed = text.trim().replaceAll("\u2212", "-");
  if (typed === "") return { why: "type a number" };
  const value = Number(typed);
  if (Number.isFinite(value) && /^[-+.\d]/.test(typed) && !/^[-+]?0[xob]/i.test(typed)) return { value };
  if (/^[-+]?\d*\.?\d*(e[-+]?\d+)?$/i.test(typed) && !Number.isFinite(value) && /\d/.test(typed)) return { why: `${typed} is too large for a number` };
  const pointed = Number(typed.replace(",", "."));
  if (/^[^,]*,[^,]*$/.test(typed) && Number.isFinite(pointed)) return { why: `${typed} is not read as a number: the decimal sign is a point (${plain(pointed, 12)})` };
  return { why: `\u201c${typed.length > 24 ? `${typed.slice(0, 24)}\u2026` : typed}\u201d is not a number` };
}

/** Small helpers for the document. */

/** The element with this id, which the page must have. */
export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no #${id}`);
  return element as T;
}

/** A new element with attributes and children; text is set as text, never as markup. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** Sets text only where it changed: screen readers and layout stay undisturbed. */
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Whether a key pressed here belongs to the element rather than to the page. */
export function takesKeys(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && target.closest("input, select, textarea, button, summary, dialog, [contenteditable]") !== null;
}

/** Whether the reader has a finger rather than a pointer that hovers. */
export function byTouch(): boolean {
  return matchMedia("(hover: none)").matches;
}

/** Calls `act` at most once per `gap` milliseconds; the last call is never lost. */
export function throttle(gap: number, act: () => void): () => void {
  let last = -Infinity;
  let timer = 0;
  const run = (): void => {
    timer = 0;
    last = performance.now();
    act();
  };
  return () => {
    if (timer) return;
    const wait = last + gap - performance.now();
    if (wait <= 0) run();
    else timer = window.setTimeout(run, wait);
  };
}

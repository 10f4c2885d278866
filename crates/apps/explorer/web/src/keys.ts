/** The list of all keys: a table of what is said here, opened by `?` or by its button. */

import { byId, make, takesKeys } from "./dom";

const KEYS: [string, [string, string][]][] = [
  ["The body", [
    ["Space", "play or pause"],
    ["r", "restart from the initial state"],
    ["k", "random kick of the shape, of the strength of the slider"],
    ["f", "keep the body in view, or not"],
  ]],
  ["The body, with the focus on it", [
    ["\u2190 \u2192 \u2191 \u2193", "put the body elsewhere; with Shift throw it"],
    ["o, i", "pull the outline out in front, push it in; with Shift at the side"],
  ]],
  ["The map, with the focus on it", [
    ["\u2190 \u2192 \u2191 \u2193", "move the parameters of the body by one cell; with Shift by eight"],
    ["+ \u2212", "zoom"],
    ["0", "the initial window"],
  ]],
  ["The branches, with the focus on them", [
    ["\u2190 \u2192", "walk along a branch"],
    ["\u2191 \u2193", "change the branch"],
    ["Page Up, Page Down", "go to special points"],
    ["Enter", "place the body on this motion"],
  ]],
  ["Everywhere", [
    ["Ctrl Z", "undo"],
    ["Ctrl Shift Z, Ctrl Y", "redo"],
    ["?", "this list"],
    ["Escape", "close a menu or a dialog"],
  ]],
];

export function startKeys(): void {
  const dialog = byId<HTMLDialogElement>("keys");
  const open = (): void => {
    if (!dialog.open) dialog.showModal();
  };
  const rows = KEYS.flatMap(([title, list]) => [
    make("tr", {}, make("th", { colspan: "2", scope: "colgroup" }, title)),
    ...list.map(([key, does]) => make("tr", {}, make("td", {}, make("kbd", {}, key)), make("td", {}, does))),
  ]);
  byId("keys-list").replaceChildren(...rows);
  byId("keys-open").addEventListener("click", open);
  byId("keys-close").addEventListener("click", () => dialog.close());
  document.addEventListener("keydown", (event) => {
    if (event.key !== "?" || event.ctrlKey || event.metaKey || event.altKey) return;
    if (takesKeys(event.target) && !(event.target instanceof HTMLButtonElement)) return;
    event.preventDefault();
    open();
  });
}

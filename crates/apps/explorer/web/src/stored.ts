/** What the browser keeps for the page. Where it denies storage, as in frames of other sites, things last as long as the page. */

type Shelf = "localStorage" | "sessionStorage";

const unkept = new Map<string, string>();

/** What was kept under this key. */
export function recall(shelf: Shelf, key: string): string | null {
  try {
    return window[shelf].getItem(key) ?? unkept.get(key) ?? null;
  } catch {
    return unkept.get(key) ?? null; // denied: the mere name of the storage is an error then
  }
}

/** Keeps a text. */
export function keep(shelf: Shelf, key: string, text: string): void {
  try {
    window[shelf].setItem(key, text);
    unkept.delete(key);
  } catch {
    unkept.set(key, text); // denied, or full
  }
}

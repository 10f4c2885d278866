/** Copying, also where the clipboard is forbidden or the page is not in a secure context. */

/** Copies the text; the button says for a moment whether that worked. */
export async function copy(text: string, button: HTMLButtonElement): Promise<void> {
  const before = button.dataset.label ?? button.textContent ?? "";
  button.dataset.label = before;
  button.textContent = (await written(text)) ? "Copied" : "Select and copy manually";
  window.setTimeout(() => (button.textContent = before), 1600);
}

async function written(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return selected(text);
  }
}

function selected(text: string): boolean {
  const area = document.createElement("textarea");
  area.value = text;
  area.className = "off-screen";
  (document.querySelector("dialog[open]") ?? document.body).append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  return done;
}

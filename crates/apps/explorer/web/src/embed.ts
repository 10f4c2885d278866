/** `?embed=body,map`: only these panels, for slides and lecture pages. Only such an address may stand in a frame of another page. */

const PANELS = ["body", "map", "parameters", "strips"];

/** Leaves only the panels of the address. */
export function startEmbed(): void {
  const wanted = new URLSearchParams(location.search).get("embed");
  if (wanted === null) return;
  const named = wanted.split(",").filter((name) => PANELS.includes(name));
  const shown = named.length ? named : ["body"];
  document.documentElement.dataset.embed = shown.join(" ");
}

/**
 * The page without a server, from what `npm run site` and cargo built; `cargo xtask web` calls it.
 *
 *     node site.mjs pack MODULE FOLDER     puts the module into the folder, compressed
 *     node site.mjs file FOLDER FILE       writes the whole folder as one page
 */

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { gunzipSync, gzipSync } from "node:zlib";

const MODULE = "motiform.wasm.gz";

/** The module of a folder. */
export function moduleOf(folder) {
  return gunzipSync(readFileSync(join(folder, MODULE)));
}

/** The page as one text: script, styles, icon and module within. */
export function oneFile(folder) {
  const text = (name) => readFileSync(join(folder, name), "utf8");
  const base64 = (name) => readFileSync(join(folder, name)).toString("base64");
  // Functions: what is put in may contain what `replace` would take for a pattern.
  const put = (page, pattern, content) => {
    if (!pattern.test(page)) throw new Error(`index.html has no ${pattern}`);
    return page.replace(pattern, () => content);
  };
  const script = text("app.js").replaceAll("</script", "<\\/script");
  let page = text("index.html");
  page = put(page, /<script defer[^>]*><\/script>/, `<script type="module">${script}</script>`);
  page = put(page, /<link rel="stylesheet"[^>]*>/, `<style>${text("app.css")}</style>`);
  page = put(page, /href="[^"]*icon\.svg"/, `href="data:image/svg+xml;base64,${base64("icon.svg")}"`);
  return put(page, /<\/body>/, `<script type="text/plain" id="module">${base64(MODULE)}</script>\n  </body>`);
}

const TASKS = {
  pack: (module, folder) => writeFileSync(join(folder, MODULE), gzipSync(readFileSync(module), { level: 9 })),
  file: (folder, file) => writeFileSync(file, oneFile(folder)),
};

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [, , task, ...rest] = process.argv;
  TASKS[task](...rest);
}

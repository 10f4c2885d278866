import { defineConfig } from "vite";
import page from "./vite.config.js";

/**
 * A classic script, where a module would be fetched by the rules of other origins: in a sandboxed frame every origin is another one, and few
 * static hosts allow it. Like a module it runs once the page is read.
 */
function classic(html) {
  return html.replace(/<script type="module" crossorigin/, "<script defer").replaceAll(/ crossorigin/g, "");
}

/** The page without a server: the same page, with another beginning. `cargo xtask web` adds the module and the page as one file. */
export default defineConfig({
  ...page,
  plugins: [
    { name: "alone", transformIndexHtml: { order: "pre", handler: (html) => html.replace("/src/main.ts", "/src/alone/main.ts") } },
    { name: "classic", transformIndexHtml: { order: "post", handler: classic } },
  ],
  worker: { format: "iife" },
  build: {
    ...page.build,
    outDir: "../../../../docs/site",
    emptyOutDir: false,
    rollupOptions: { output: { ...page.build.rollupOptions.output, format: "iife" } },
  },
});

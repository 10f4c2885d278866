import { defineConfig } from "vite";
import page from "./vite.config.js";

/** The page without a server: the same page, with another beginning. `cargo xtask web` adds the module and the page as one file. */
export default defineConfig({
  ...page,
  plugins: [{ name: "alone", transformIndexHtml: { order: "pre", handler: (html) => html.replace("/src/main.ts", "/src/alone/main.ts") } }],
  worker: { format: "iife" },
  build: { ...page.build, outDir: "../../../docs/site", emptyOutDir: false },
});

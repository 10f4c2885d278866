import { defineConfig } from "vite";

/**
 * `npm run dev` shows the page with the data of a running `motiform explore`: MOTIFORM_URL is the address it printed.
 * The server accepts its own host and origin only, so both are rewritten.
 */
function liveProxy() {
  const address = process.env.MOTIFORM_URL;
  if (!address) return undefined;
  const { origin, host, pathname } = new URL(address);
  return {
    "/live": {
      target: origin.replace(/^http/, "ws"),
      ws: true,
      headers: { host, origin },
      rewrite: () => `${pathname.replace(/\/$/, "")}/live`,
    },
  };
}

export default defineConfig({
  base: "./",
  server: { proxy: liveProxy() },
  build: {
    outDir: "../page",
    emptyOutDir: true,
    target: "es2022",
    modulePreload: false,
    cssCodeSplit: false,
    sourcemap: false,
    assetsInlineLimit: 0,
    rollupOptions: {
      output: { entryFileNames: "app.js", assetFileNames: "app.[ext]", codeSplitting: false },
    },
  },
});

/** The checker axe, run within a page. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const RULES = ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa", "best-practice", "experimental"];

/** Fails where axe finds anything; all parameters are shown first. */
export async function assertAccessible(page) {
  await page.locator("#map-legend li").first().waitFor();
  await page.evaluate(() => document.querySelectorAll("#parameters details, #parameter-details").forEach((one) => (one.open = true)));
  if (page.context().browser().browserType().name() === "chromium") {
    const session = await page.context().newCDPSession(page);
    await session.send("Runtime.evaluate", { expression: AXE }); // not bound by the page's own policy
  } else {
    await page.evaluate(AXE);
  }
  const { violations } = await page.evaluate((runOnly) => window.axe.run(document, { runOnly }), RULES);
  assert.deepEqual(violations.map(({ id, impact, nodes }) => `${impact} ${id}: ${nodes.slice(0, 4).map((one) => `${one.target} ${one.failureSummary}`).join(" | ")}`), []);
}

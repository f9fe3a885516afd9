// SPDX-License-Identifier: Apache-2.0
// What the checks of all pages do in a browser.
import assert from "node:assert/strict";

/** A new page with its requests, and what its console and its errors say. */
export async function open(context, url) {
  const page = await context.newPage();
  page.requests = [];
  page.complaints = [];
  page.on("request", (request) => page.requests.push(request.url()));
  page.on("console", (message) => page.complaints.push(message.text()));
  page.on("pageerror", (error) => page.complaints.push(error.message));
  await page.goto(url);
  return page;
}

/** In both color schemes, on wide and narrow screens. `unfold` opens folded parts, so that they are checked as well;
 * `settings`: more of the browser. */
export async function isAccessible(browser, url, axeSource, unfold, settings = {}) {
  for (const colorScheme of ["light", "dark"]) {
    for (const width of [1280, 360]) {
      const context = await browser.newContext({ colorScheme, viewport: { width, height: 900 }, ...settings });
      const page = await open(context, url);
      await unfold(page);
      // The page's own policy lets no script in: axe comes through the debugger.
      const result = await page.evaluate(`${axeSource}; axe.run(document, {resultTypes: ["violations"]})`);
      const found = result.violations.map((one) => `${one.id}: ${one.nodes[0].html} ${one.nodes[0].failureSummary}`);
      assert.deepEqual(found, [], `${colorScheme}, ${width} px`);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `${width} px: the page is ${wide} px wide`);
      await context.close();
    }
  }
}

// SPDX-License-Identifier: Apache-2.0
// How long a page of many assets takes to open and to filter. The assets are those of a real page,
// pictures included, repeated under other names.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";

const OPEN_MS = 1000;
const FILTER_MS = 100;

function enlarge(source, target, wanted) {
  const page = readFileSync(source, "utf8");
  const begin = page.indexOf(">", page.indexOf('<script id="data"')) + 1;
  const end = page.indexOf("</script>", begin);
  const data = JSON.parse(page.slice(begin, end));
  const few = data.assets;
  data.assets = Array.from({ length: wanted }, (_, i) =>
    ({ ...few[i % few.length], path: `library/${i % 37}/${i}-${few[i % few.length].path}` }));
  const text = JSON.stringify(data).replaceAll("<", "\\u003c");
  writeFileSync(target, page.slice(0, begin) + text + page.slice(end));
  return (text.length / 1e6).toFixed(1);
}

async function measure(browser, url) {
  const page = await browser.newPage();
  const begin = performance.now();
  await page.goto(url);
  await page.locator("#list > li").first().waitFor();
  const opened = performance.now() - begin;
  const filtered = [];
  for (const [id, text] of [["text", "translucency"], ["text", "no such thing"], ["text", ""], ["path", "/7/"],
    ["path", ""]]) {
    filtered.push(await page.evaluate(([name, value]) => {
      const input = document.getElementById(name);
      const start = window.performance.now();
      input.value = value;
      input.dispatchEvent(new Event("input", { bubbles: true }));
      document.body.getBoundingClientRect();  // with its layout
      return window.performance.now() - start;
    }, [id, text]));
  }
  await page.close();
  return { opened, filtered: Math.max(...filtered) };
}

/** [name, check] */
export function speedChecks(browser, source, target, url) {
  return [300, 3000].map((count) => [`${count} assets open in ${OPEN_MS} ms and filter in ${FILTER_MS} ms`, async () => {
    const megabytes = enlarge(source, target, count);
    await measure(browser, url);
    const runs = [await measure(browser, url), await measure(browser, url), await measure(browser, url)];
    const opened = Math.min(...runs.map((one) => one.opened));
    const filtered = Math.min(...runs.map((one) => one.filtered));
    console.log(`  ${count} assets, ${megabytes} MB: opens in ${opened.toFixed(0)} ms, filters in ${filtered.toFixed(0)} ms`);
    assert.ok(opened <= OPEN_MS, `opens in ${opened} ms`);
    assert.ok(filtered <= FILTER_MS, `filters in ${filtered} ms`);
  }]);
}

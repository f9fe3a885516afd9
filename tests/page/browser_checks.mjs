// SPDX-License-Identifier: Apache-2.0
// Behaviour of the page in a browser. Each check gets a fresh page and throws on failure.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { BREAKERS } from "./hostile.mjs";
import { isAccessible, open } from "./in_browser.mjs";
import { requirementChecks } from "./requirements.mjs";

const shownCount = (page) => page.locator("#count").textContent();
const rows = (page) => page.locator("#list > li").count();

/** Opens folded parts, so that they are checked as well. */
async function unfold(page) {
  for (const fold of await page.locator(".fold > summary").all()) await fold.click();
  for (let i = 0; i < Math.min(4, await rows(page)); ++i) {
    await page.locator("#list > li").nth(i).locator("summary").first().click();
  }
  for (const external of await page.locator(".external > summary").all()) await external.click();
  const finding = page.locator(".finding details > summary").first();
  if (await finding.isVisible()) await finding.click();
}

async function loadsNothing(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  await unfold(page);
  const others = page.requests.filter((one) => one !== url && !one.startsWith("data:image/webp;base64,"));
  assert.deepEqual(others, []);
  assert.deepEqual(page.complaints, []);
  await context.close();
}

async function listsExternalAssets(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  await page.fill("#path", "bad/external-invalid.gltf");
  assert.equal(await rows(page), 1);
  const state = await page.locator("#list .state").textContent();
  await page.locator("#list > li summary").first().click();
  const external = page.locator(".external");
  assert.equal(await external.count(), 1);
  assert.match(await external.locator("summary").first().textContent(), /\.gltf.* errors?.* warnings?/);
  assert.equal(await external.locator(".finding").count(), 0);
  await external.locator("summary").first().click();
  assert.ok(await external.locator(".finding.error").count() > 0);
  assert.match(state, /^\d+ errors?/);
  assert.doesNotMatch(state, /warning/, "findings of external assets do not count");
  await context.close();
}

async function textStaysText(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  await page.fill("#path", "hostile");
  const count = await rows(page);
  assert.equal(count, BREAKERS.length + 1);
  for (let i = 0; i < count; ++i) await page.locator("#list > li").nth(i).locator("summary").first().click();
  await page.waitForFunction((all) => document.querySelectorAll("#list .body").length === all, count);
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.equal(await page.locator("#list svg, #list script, #list b >> text=hostile").count(), 0);
  assert.equal(await page.locator('a[href^="javascript"]').count(), 0);
  const text = await page.locator("#list").textContent();
  assert.ok(text.includes("</script><img src=x onerror=window.broken=1>"));
  assert.ok(text.includes("\\u202egnp.elif"));
  assert.ok(text.includes("مرحبا بالعالم"));
  assert.ok(!/[\u0000-\u0008\u202e]/.test(text));
  assert.deepEqual(page.complaints, []);
  await context.close();
}

async function filters(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const all = await shownCount(page);
  assert.match(all, /^\d+ assets$/);
  await page.fill("#path", "fixtures/tour/");
  assert.equal(await shownCount(page), `1 of ${all}`);
  await page.fill("#path", "");
  await page.fill("#text", "did you mean 'metallicfactor'");
  assert.equal(await shownCount(page), all.replace(/^/, "0 of "));
  await page.fill("#text", "metalicFactor");
  assert.equal(await shownCount(page), `1 of ${all}`);
  await page.locator("#list summary").first().click();
  await page.locator(".finding").first().waitFor();
  const everything = await page.locator(".finding").count();
  await page.selectOption("#verdict", "warning");
  await page.locator("#list summary").first().click();
  await page.locator(".finding").first().waitFor();
  const warnings = await page.locator(".finding").count();
  assert.ok(warnings > 0 && warnings < everything);
  assert.equal(await page.locator(".finding:not(.warning)").count(), 0);
  await page.click("#reset");
  await page.waitForFunction((wanted) => document.getElementById("count").textContent === wanted, all);
  await page.selectOption("#rule", "UNRESOLVED_REFERENCE");
  assert.match(await shownCount(page), / of /);
  await page.click("#reset");
  await page.waitForFunction((wanted) => document.getElementById("count").textContent === wanted, all);
  await page.locator(".fold > summary").first().click();
  await page.locator(".fold td a").first().click();
  await page.waitForFunction(() => / of /.test(document.getElementById("count").textContent));
  assert.match(await page.evaluate(() => location.hash), /^#rule=[A-Z0-9_]+$/);
  await context.close();
}

/** The matrix of targets agrees with the findings, and its links filter by them. */
async function showsTargets(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const { targets, assets } = await page.evaluate(() => JSON.parse(document.getElementById("data").textContent));
  assert.deepEqual(targets.map((one) => one.split(" ")[0]), ["Babylon.js", "Blender", "three.js"]);
  const fold = page.locator(".fold", { has: page.getByRole("heading", { name: "Targets" }) });
  await fold.locator("summary").click();
  const cells = await fold.locator("tbody tr").evaluateAll((lines) => lines.map((line) => [...line.cells].map((cell) => cell.textContent)));
  assert.ok(cells.length > 10);
  for (const [, words, ...counts] of cells) {
    targets.forEach((target, i) => {
      const having = assets.filter((asset) => asset.findings.some((one) => one.message === `${target} ${words}`));
      assert.equal(counts[i], String(having.length), `${target} ${words}`);
    });
  }
  const said = assets.flatMap((asset) => asset.findings).filter((one) => one.code.startsWith("TARGET_")).map((one) => one.message);
  const listed = cells.flatMap(([, words]) => targets.map((target) => `${target} ${words}`));
  assert.deepEqual([...new Set(said)].filter((one) => !listed.includes(one)), []);
  await fold.locator("td a").first().focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => / of /.test(document.getElementById("count").textContent));
  assert.equal(await page.inputValue("#text"), cells[0][1]);
  await context.close();
}

async function sorts(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const errors = async () => page.locator("#list .state").first().textContent();
  assert.match(await errors(), /not readable|errors?/);
  await page.selectOption("#order", "size");
  const sizes = await page.evaluate(() => {
    const data = JSON.parse(document.getElementById("data").textContent).assets;
    return Math.max(...data.map((one) => (one.facts ? one.facts.bytes.total : 0)));
  });
  const first = await page.locator("#list .path h3").first().textContent();
  const largest = await page.evaluate((most) => JSON.parse(document.getElementById("data").textContent).assets
    .filter((one) => one.facts && one.facts.bytes.total === most).map((one) => one.path), sizes);
  assert.ok(largest.some((path) => path.endsWith(first)));
  await context.close();
}

async function addressHoldsTheState(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  await page.selectOption("#order", "name");
  const paths = await page.evaluate(() => shown.map((one) => one.path));
  assert.deepEqual(paths, paths.slice().sort((a, b) => (a < b ? -1 : 1)));
  await page.selectOption("#verdict", "error");
  await page.selectOption("#rule", "UNRESOLVED_REFERENCE");
  await page.locator("#list summary").first().click();
  await page.locator(".finding").first().waitFor();
  const count = await shownCount(page);
  const path = await page.locator("#list details[open] .path-line bdi").textContent();
  const address = await page.evaluate(() => location.href);
  assert.match(address, /#.*rule=UNRESOLVED_REFERENCE/);
  const other = await open(context, address);
  assert.equal(await shownCount(other), count);
  assert.equal(await other.locator("#list details[open] .path-line bdi").textContent(), path);
  await other.click("#reset");
  assert.equal(await other.evaluate(() => location.hash), "#assets");
  // Links from elsewhere: to a rule, to a rule that found nothing, to an asset.
  await other.evaluate(() => { location.hash = "#rule=UNRESOLVED_REFERENCE"; });
  await other.waitForFunction(() => document.getElementById("rule").value === "UNRESOLVED_REFERENCE");
  const found = await other.evaluate(() => shown.every((one) => one.findings.some((each) => each.code === "UNRESOLVED_REFERENCE")));
  assert.ok(found);
  const top = await other.evaluate(() => document.getElementById("assets").getBoundingClientRect().top);
  assert.ok(Math.abs(top) < 40, `the assets are ${top} px below the top`);
  const none = await open(context, url + "#rule=UNUSUAL_SCALE");
  assert.match(await shownCount(none), /^0 of \d+ assets: UNUSUAL_SCALE found nothing$/);
  // Plus signs and blanks of a path, as people write them and as the page does.
  const plus = await page.evaluate(() => report.assets.find((one) => one.path.includes("+")).path);
  for (const written of [encodeURIComponent(plus).replaceAll("%2B", "+"), encodeURIComponent(plus)]) {
    const added = await open(context, url + "#asset=" + written);
    assert.equal(await added.locator("#list details[open] .path-line bdi").textContent(), plus);
    await added.waitForFunction((wanted) => location.hash === wanted, "#asset=" + encodeURIComponent(plus));
  }
  const linked = await open(context, url + "#asset=" + encodeURIComponent(path));
  assert.equal(await linked.locator("#list details[open] .path-line bdi").textContent(), path);
  assert.match(await shownCount(linked), /^\d+ assets$/);
  // Anything in an address is text.
  const wild = await open(context, url + "#verdict=%3Cb%3E&order=x&rule=<b id=none>&text=<i id=none onerror=window.broken=1>&asset=no");
  assert.match(await shownCount(wild), /^0 of /);
  assert.equal(await wild.evaluate(() => window.broken), undefined);
  assert.deepEqual(wild.complaints, []);
  await context.close();
}

async function showsLengths(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const text = (sides) => page.evaluate((max) => boundsText({ min: [0, 0, 0], max }), sides);
  assert.equal(await text([0.0054, 0.001, 0]), "5.4 × 1 × 0 mm");
  assert.equal(await text([0.32, 0.12, 0.0951]), "32 × 12 × 9.51 cm");
  assert.equal(await text([1.7, 12.345, 900]), "1.7 × 12.3 × 900 m");
  assert.equal(await text([1000, 12, 1.2e24]), "1 × 0.012 × 1.2e+21 km");
  await context.close();
}

async function copiesPaths(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  await page.locator("#list summary").first().click();
  const line = page.locator(".path-line").first();
  await line.locator("button").click();
  await page.waitForFunction(() => /Copied|Selected/.test(document.querySelector(".path-line [role=status]").textContent));
  await context.close();
}

async function worksByKeyboard(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Skip to the assets");
  const first = page.locator("#list summary").first();
  await first.focus();
  await page.keyboard.press("Enter");
  await page.locator("#list details[open] .body").waitFor();
  const outline = await first.evaluate((element) => getComputedStyle(element).outlineStyle);
  assert.equal(outline, "solid");
  await page.keyboard.press("/");
  assert.equal(await page.evaluate(() => document.activeElement.id), "text");
  await page.keyboard.type("a/b");
  assert.equal(await page.inputValue("#text"), "a/b");
  await page.locator('.theme input[value="auto"]').focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await context.close();
}

async function showsAllInTheEnd(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const all = Number((await shownCount(page)).match(/\d+/)[0]);
  const before = await rows(page);
  assert.ok(before < all, "the list is built in parts");
  // It grows by itself where it is scrolled, and by its button.
  await page.evaluate(() => window.scrollTo(0, document.body.scrollHeight));
  await page.waitForFunction((few) => document.getElementById("list").childElementCount > few, before);
  await page.evaluate(() => {
    const more = document.getElementById("more");
    while (!more.hidden) more.click();
  });
  assert.equal(await rows(page), all);
  await context.close();
}

/** [name, check]. `limitsUrl`: the page with requirements. */
export function browserChecks(browser, url, limitsUrl, axePath) {
  const axeSource = readFileSync(axePath, "utf8");
  return [
    ["accessible in both themes, at 1280 and 360 px", () => isAccessible(browser, url, axeSource, unfold)],
    ["requirements are accessible, too", () => isAccessible(browser, `${limitsUrl}#verdict=error`, axeSource, unfold)],
    ["so is their matrix", () => isAccessible(browser, `${limitsUrl}#view=matrix`, axeSource, unfold)],
    ...requirementChecks(browser, limitsUrl, open),
    ["loads nothing and complains of nothing", () => loadsNothing(browser, url)],
    ["external assets are accessible, too",
      () => isAccessible(browser, `${url}#path=bad/external-`, axeSource, unfold)],
    ["lists external assets", () => listsExternalAssets(browser, url)],
    ["text of assets stays text", () => textStaysText(browser, url)],
    ["filters", () => filters(browser, url)],
    ["shows what targets lose", () => showsTargets(browser, url)],
    ["sorts", () => sorts(browser, url)],
    ["address holds filters and the open asset", () => addressHoldsTheState(browser, url)],
    ["shows lengths with a unit that fits", () => showsLengths(browser, url)],
    ["copies paths", () => copiesPaths(browser, url)],
    ["works by keyboard", () => worksByKeyboard(browser, url)],
    ["shows all in the end", () => showsAllInTheEnd(browser, url)],
  ];
}

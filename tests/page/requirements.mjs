// SPDX-License-Identifier: Apache-2.0
// Requirements on the page: limits, what was measured, and what an earlier run measured.
import assert from "node:assert/strict";
import { BREAKERS } from "./hostile.mjs";

const BEGIN = '<script id="data" type="application/json">';

/** Requirements of one asset, as the program writes them. `at`: its place in the report. */
function requirementsOf(asset, at) {
  const triangles = asset.facts ? asset.facts.counts.triangles : null;
  const text = BREAKERS[at % BREAKERS.length];
  const key = (entry) => ({ key: [entry.on, entry.measure, entry.op, entry.limit].join(" "), ...entry });
  const fail = (value, limit) => (value > limit ? { verdict: "fail", failed: 1 } : { verdict: "pass" });
  return [
    { measure: "triangles", on: "asset", op: "max", limit: 100, from: "gltfx.toml:3", severity: "error", value: triangles,
      ...(triangles === null ? { verdict: "not-measured", notMeasured: 1 } : fail(triangles, 100)),
      before: { value: 101, verdict: "fail", failed: 1 } },
    { measure: "texture-size", on: "image", op: "max", limit: 512, unit: "px", from: "preset shop (1.0, 2020-10-20)", severity: "warning",
      value: 2048, verdict: "fail", failed: 5, notMeasured: 1,
      elements: [0, 1, 2, 3, 4].map((i) => ({ pointer: `/images/${i}`, object: text, value: 2048 })) },
    { measure: "name", on: "mesh", op: "match", limit: text, from: text, severity: "error", value: text, verdict: "fail", failed: 1,
      elements: [{ pointer: "/meshes/0", object: text, value: text }] },
    { measure: "extensions", on: "asset", op: "allow", limit: ["KHR_*", text], from: "gltfx.toml:9", severity: "error", value: [text, "KHR_a"], verdict: "pass" },
    { measure: "root-transform", on: "asset", op: "equal", limit: true, from: "gltfx.toml:10", severity: "hint", value: true, verdict: "pass" },
    { measure: "hard-edges", on: "mesh", op: "max", limit: 9, parameters: text, from: "gltfx.toml:11", severity: "error", value: null, verdict: "not-applicable" },
  ].map(key);
}

/** The page with requirements for every asset but the last. */
export function withRequirements(html) {
  const begin = html.indexOf(BEGIN) + BEGIN.length;
  const end = html.indexOf("</script>", begin);
  const data = JSON.parse(html.slice(begin, end));
  data.assets.slice(0, -1).forEach((asset, at) => { asset.requirements = requirementsOf(asset, at); });
  return html.slice(0, begin) + JSON.stringify(data).replaceAll("<", "\\u003c") + html.slice(end);
}

const data = (page) => page.evaluate(() => JSON.parse(document.getElementById("data").textContent));
const shownCount = (page) => page.locator("#count").textContent();

/** The table over all assets agrees with the assets, and its numbers lead to them. */
async function countsAssets(browser, url, open) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const { assets } = await data(page);
  const checked = assets.filter((asset) => asset.requirements).map((asset) => asset.requirements[0]);
  const failed = checked.filter((one) => one.failed).length;
  const unknown = checked.filter((one) => one.notMeasured).length;
  assert.ok(failed > 0 && unknown > 0 && failed + unknown < checked.length);
  const fold = page.locator(".fold", { has: page.getByRole("heading", { name: "Requirements" }) });
  await fold.locator("summary").click();
  const line = fold.locator("tbody tr", { hasText: "≤ 100" });
  const cells = await line.locator("td").allTextContents();
  assert.deepEqual(cells, ["triangles", "≤ 100", "error", "gltfx.toml:3", String(failed), String(checked.length), String(unknown),
    String(checked.length - failed - unknown), "0"]);
  await line.getByRole("link", { name: `${failed} fail` }).click();
  await page.waitForFunction(() => / of /.test(document.getElementById("count").textContent));
  assert.equal(await shownCount(page), `${failed} of ${assets.length} assets`);
  assert.equal(await page.inputValue("#result"), "fail");
  const other = await open(context, await page.evaluate(() => location.href));
  assert.equal(await shownCount(other), await shownCount(page));
  await other.click("#reset");
  await other.selectOption("#result", "not-measured");
  const without = assets.filter((asset) => (asset.requirements || []).some((one) => one.notMeasured && !one.failed));
  assert.equal(await shownCount(other), `${without.length} of ${assets.length} assets`);
  await context.close();
}

async function listsThemOfAnAsset(browser, url, open) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const { assets } = await data(page);
  const asset = assets.find((one) => one.requirements && one.requirements[0].failed);
  await page.goto(`${url}#asset=${encodeURIComponent(asset.path)}`);
  await page.reload();
  const part = page.locator("details[open] .requirements");
  const lines = await part.locator("tbody > tr").evaluateAll((all) => all.map((one) => [...one.cells].map((cell) => cell.textContent)));
  assert.equal(lines.length, asset.requirements.length);
  const triangles = lines.find((cells) => cells[1].startsWith("triangles"));
  assert.equal(triangles[0], "✗ fail");
  assert.equal(triangles[2], String(asset.requirements[0].value).replace(/\B(?=(\d{3})+$)/g, ","));
  assert.equal(triangles[3], "≤ 100");
  assert.equal(triangles[4], triangles[2] === "101" ? "same" : "101");
  assert.equal(triangles[5], "gltfx.toml:3");
  const images = lines.find((cells) => cells[1].startsWith("image texture-size"));
  assert.ok(images[1].includes("6 images"));
  assert.equal(images[3], "≤ 512\u00a0px");
  assert.deepEqual(lines.map((cells) => cells[0].slice(2)), ["fail", "fail", "fail", "pass", "pass", "not applicable"]);
  await context.close();
}

async function drawsTheMatrix(browser, url, open) {
  const context = await browser.newContext();
  const page = await open(context, `${url}#view=matrix`);
  const { assets } = await data(page);
  assert.equal(await page.locator("#list").isVisible(), false);
  const heads = await page.locator("#matrix thead th").allTextContents();
  assert.equal(heads[0], "asset");
  assert.ok(heads.includes("triangles≤ 100"));
  await page.evaluate(() => {
    const more = document.getElementById("more");
    while (!more.hidden) more.click();
  });
  assert.equal(await page.locator("#matrix tbody tr").count(), assets.length);
  await page.selectOption("#result", "fail");
  await page.selectOption("#requirement", "asset triangles max 100");
  const failed = assets.filter((asset) => asset.requirements && asset.requirements[0].failed);
  assert.equal(await shownCount(page), `${failed.length} of ${assets.length} assets`);
  assert.deepEqual(await page.locator("#matrix thead th").allTextContents(), ["asset", "triangles≤ 100"]);
  assert.match(await page.locator("#matrix tbody td").first().textContent(), /^✗fail [\d,]+/);
  const address = await page.evaluate(() => location.hash);
  assert.equal(address, "#requirement=asset%20triangles%20max%20100&result=fail&view=matrix");
  const name = await page.locator("#matrix tbody a").first().textContent();
  await page.locator("#matrix tbody a").first().click();
  await page.locator("#list details[open] .body").waitFor();
  assert.equal(await page.locator("#matrix").isVisible(), false);
  assert.ok((await page.locator("#list details[open] .path-line bdi").textContent()).endsWith(name));
  await context.close();
}

async function textStaysText(browser, url, open) {
  const context = await browser.newContext();
  const page = await open(context, `${url}#view=matrix`);
  for (const fold of await page.locator(".fold > summary").all()) await fold.click();
  assert.equal(await page.evaluate(() => window.broken), undefined);
  const text = await page.locator("main").textContent();
  assert.ok(text.includes("</script><img src=x onerror=window.broken=1>") && text.includes("\\u202e"));
  assert.ok(!/[\u0000-\u0008\u202e]/.test(text));
  assert.deepEqual(page.complaints, []);
  await context.close();
}

async function writesValues(browser, url, open) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const limit = (entry) => page.evaluate((one) => [valueText(one.value, one.unit, needsDigits(one)), limitText(one)], entry);
  assert.deepEqual(await limit({ op: "max", value: 1250, limit: 1000 }), ["1,250", "≤ 1,000"]);
  assert.deepEqual(await limit({ op: "min", value: 0.123456, limit: 0.01, unit: "m" }), ["0.1235\u00a0m", "≥ 0.01\u00a0m"]);
  assert.deepEqual(await limit({ op: "max", value: 5242881, limit: 5242880, unit: "B" }), ["5,242,881\u00a0B", "≤ 5,242,880\u00a0B"]);
  assert.deepEqual(await limit({ op: "max", value: 6e6, limit: 5242880, unit: "B" }), ["6.00 MB", "≤ 5.24 MB"]);
  assert.deepEqual(await limit({ op: "equal", value: false, limit: true }), ["no", "= yes"]);
  assert.deepEqual(await limit({ op: "unique", value: "a", limit: true }), ["‘a’", "unique"]);
  assert.deepEqual(await limit({ op: "deny", value: [], limit: ["A", "B"] }), ["none", "not A, B"]);
  assert.deepEqual(await limit({ op: "max", value: null, limit: 1 }), ["–", "≤ 1"]);
  assert.deepEqual(await limit({ op: "min", value: -1234.5, limit: -2000 }), ["-1,235", "≥ -2,000"]);
  await context.close();
}

/** [name, check]; `open`: opens an address. */
export function requirementChecks(browser, url, open) {
  return [
    ["counts the assets that meet a limit", () => countsAssets(browser, url, open)],
    ["lists the requirements of an asset", () => listsThemOfAnAsset(browser, url, open)],
    ["draws the matrix of requirements", () => drawsTheMatrix(browser, url, open)],
    ["text of requirements stays text", () => textStaysText(browser, url, open)],
    ["writes values with units and digits", () => writesValues(browser, url, open)],
  ];
}

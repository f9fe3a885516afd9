// SPDX-License-Identifier: Apache-2.0
// The page of `gltfx compare`: assets for it, and its behaviour in a browser.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { BREAKERS } from "./hostile.mjs";
import { isAccessible, open } from "./in_browser.mjs";

const BUFFER = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAECAAID";
const PAIRS = 60;  // more than the list shows at once

function squares(name, roughness, place) {
  return JSON.stringify({
    asset: { version: "2.0", copyright: name }, scene: 0, scenes: [{ nodes: [0, 1] }],
    nodes: [{ name, mesh: 0, extras: { note: name } }, { name: "Right", mesh: 0, translation: [place, 0, 0] }],
    meshes: [{ name, primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
    materials: [{ name, doubleSided: true, pbrMetallicRoughness: { roughnessFactor: roughness } }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 4, type: "VEC3", min: [0, 0, 0], max: [1, 1, 0] },
      { bufferView: 1, componentType: 5121, count: 6, type: "SCALAR" }],
    bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 6 }],
    buffers: [{ byteLength: 54, uri: "data:application/octet-stream;base64," + BUFFER }],
  }, null, 1);
}

/** Writes two folders; returns their paths. Texts of all assets would like to be markup. */
export function writePairs(folder) {
  const places = ["old", "new"].map((name) => join(folder, name));
  for (const place of places) mkdirSync(place, { recursive: true });
  for (let i = 0; i < PAIRS; ++i) {
    const text = BREAKERS[i % BREAKERS.length];
    const name = `${i}<img src=x>.gltf`;
    writeFileSync(join(places[0], name), squares(text, 0.25, 3));
    writeFileSync(join(places[1], name), squares(i === 0 ? text + "2" : text, 0.5, i % 2 ? 3 : 4));
  }
  writeFileSync(join(places[0], "gone.gltf"), squares("gone", 0.5, 3));
  writeFileSync(join(places[1], "same.gltf"), squares("same", 0.5, 3));
  writeFileSync(join(places[0], "same.gltf"), squares("same", 0.5, 3));
  return places;
}

async function unfoldFirst(page, count) {
  for (let i = 0; i < count; ++i) await page.locator("#list > li").nth(i).locator("summary").click();
}

async function unfoldSome(page) {
  await unfoldFirst(page, 3);
  const sliders = page.locator('.pictures-part input[value="slider"]');
  if (await sliders.count() > 0) await sliders.last().check({ force: true });
}

async function textStaysText(browser, url) {
  assert.ok(!/[\u0000-\u0008\u202a-\u202e\u2066-\u2069]/.test(readFileSync(new URL(url), "utf8")));
  const context = await browser.newContext();
  const page = await open(context, url);
  await page.evaluate(() => { while (!document.getElementById("more").hidden) document.getElementById("more").click(); });
  assert.equal(await page.locator("#list > li").count(), PAIRS + 2);
  await unfoldFirst(page, 2 * BREAKERS.length);
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.equal(await page.locator("#list svg, #list script, img[src=x]").count(), 0);
  const text = await page.locator("#list").textContent();
  assert.ok(text.includes("</script><img src=x onerror=window.broken=1>"));
  assert.ok(!/[\u0000-\u0008\u202e]/.test(text));
  assert.deepEqual(page.complaints, []);
  assert.deepEqual(page.requests.filter((one) => one !== url && !one.startsWith("data:image/webp;base64,")), []);
  await context.close();
}

async function filters(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  const count = () => page.locator("#count").textContent();
  assert.equal(await count(), `${PAIRS + 2} pairs`);
  await page.selectOption("#level", "identical");
  assert.equal(await count(), `1 of ${PAIRS + 2} pairs`);
  await page.click("#reset");
  await page.selectOption("#kind", "node.moved");
  assert.equal(await count(), `${PAIRS / 2} of ${PAIRS + 2} pairs`);
  await page.fill("#text", "gone.gltf");
  assert.equal(await count(), `0 of ${PAIRS + 2} pairs`);
  await page.click("#reset");
  assert.equal(await count(), `${PAIRS + 2} pairs`);
  await context.close();
}

/** All by keys: a pair, its comparisons, the slider, a change. */
async function worksByKeyboard(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  await page.selectOption("#kind", "node.moved");
  await page.locator("#list summary").first().focus();
  await page.keyboard.press("Enter");
  await page.locator(".stage").waitFor();
  if (await page.locator(".pictures-part").count() > 0) {
    await page.locator('.pictures-part input[value="side"]').focus();
    await page.keyboard.press("ArrowRight");
    await page.locator(".stage.slider .slide").focus();
    await page.keyboard.press("End");
    assert.equal(await page.locator(".slides").evaluate((frame) => frame.style.getPropertyValue("--cut")), "100%");
    await page.keyboard.press("3");
    await page.locator(".stage.blink").waitFor();
    await page.getByRole("button", { name: "Swap" }).focus();
    await page.keyboard.press("Enter");
    const name = await page.locator(".side-name").textContent();
    await page.keyboard.press("Enter");
    assert.notEqual(await page.locator(".side-name").textContent(), name);
    await page.keyboard.press("4");
    await page.locator(".stage.difference img").waitFor();
  }
  await page.locator(".changes .pick").first().focus();
  await page.keyboard.press("Enter");
  assert.equal(await page.locator("tr.picked").count(), 1);
  await page.keyboard.press("/");
  assert.equal(await page.evaluate(() => document.activeElement.id), "text");
  await context.close();
}

/** A change whose object is drawn is marked in the picture. */
async function marksChanges(browser, url) {
  const context = await browser.newContext();
  const page = await open(context, url);
  await page.selectOption("#kind", "node.moved");
  await page.locator("#list summary").first().click();
  const row = page.locator(".changes tr", { hasText: "node.moved" });
  await row.locator(".pick").click();
  assert.ok(await row.evaluate((element) => element.classList.contains("picked")));
  if (await page.locator(".pictures-part").count() > 0) assert.ok(await page.locator(".region").count() > 0);
  await context.close();
}

/** Pairs are shown before all of a large page is read. */
async function showsPairsWhileItIsRead(browser, url) {
  const text = readFileSync(new URL(url), "utf8");
  const end = text.indexOf("</script>", text.indexOf("<script type=\"application/json\">", text.length / 2));
  const [first, rest] = [text.slice(0, end), text.slice(end)];
  let finish = () => {};
  const server = createServer((request, response) => {
    response.writeHead(200, { "content-type": "text/html; charset=utf-8" });
    response.write(first);
    finish = () => response.end(rest);
  });
  await new Promise((listening) => server.listen(0, "localhost", listening));
  const context = await browser.newContext();
  const page = await context.newPage();
  try {
    await page.goto("http:" + `//localhost:${server.address().port}/`, { waitUntil: "commit" });
    await page.locator("#list > li").first().waitFor();
    assert.match(await page.locator("#count").textContent(), /^\d+ pairs so far$/);
    finish();
    await page.getByText(`${PAIRS + 2} pairs`, { exact: true }).waitFor();
  } finally {
    await context.close();
    server.close();
  }
}

/** [name, check] */
export function compareChecks(browser, url, axeSource) {
  return [
    ["the page of a comparison is accessible", () => isAccessible(browser, url, axeSource, unfoldSome, { reducedMotion: "reduce" })],
    ["text of compared assets stays text", () => textStaysText(browser, url)],
    ["pairs are filtered by level, kind and text", () => filters(browser, url)],
    ["pairs are shown while the page is read", () => showsPairsWhileItIsRead(browser, url)],
    ["comparisons work by keyboard", () => worksByKeyboard(browser, url)],
    ["changes are marked in pictures", () => marksChanges(browser, url)],
  ];
}

// SPDX-License-Identifier: Apache-2.0
// The page with a keyboard, a screen reader, a dark theme or a narrow window.
import assert from "node:assert/strict";
import { join } from "node:path";
import { archive } from "./archives.mjs";
import { choose, chooseFolder, drop, open, unfold } from "./browsers.mjs";

async function soundFor(page, axeSource, words) {
  // The page's own policy lets no script in: axe comes through the debugger.
  const result = await page.evaluate(`${axeSource}; axe.run(document, { resultTypes: ["violations"] })`);
  const found = result.violations.map(
    (each) => `${each.id}: ${each.nodes[0].html} ${each.nodes[0].failureSummary}`,
  );
  assert.deepEqual(found, [], words);
  const [wide, width] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
  assert.ok(wide <= width, `${words}: the page is ${wide} px wide`);
}

async function isAccessible(one, url, native, axeSource) {
  for (const scheme of ["light", "dark"]) {
    for (const width of [1280, 360]) {
      const words = `${scheme}, ${width} px`;
      const page = await open(one, url, { width, scheme });
      await soundFor(page, axeSource, `${words}, at the start`);
      await chooseFolder(one, page, native.folder);
      await soundFor(page, axeSource, `${words}, folded`);
      await unfold(page);
      await soundFor(page, axeSource, `${words}, unfolded`);
      const zip = archive([
        { path: "../a.gltf", bytes: Buffer.from("{}") },
        { path: `${"long".repeat(40)}.gltf`, bytes: Buffer.from("{}") },
      ]);
      await drop(page, [["left-out.zip", zip]]);
      await page.$eval("#left-out details", (fold) => {
        fold.open = true;
      });
      await soundFor(page, axeSource, `${words}, with what is left out`);
      assert.deepEqual(page.complaints, []);
      await page.close();
    }
  }
}

/** Where parts of the page are: [top, bottom] of each. */
function places(page, ...selectors) {
  const at = (all) =>
    all.map((selector) => {
      const { top, bottom } = document.querySelector(selector).getBoundingClientRect();
      return [top, bottom];
    });
  return page.evaluate(at, selectors);
}

async function isLaidOut(one, url, native) {
  for (const width of [1280, 390]) {
    const page = await open(one, url, { width });
    for (const choice of [() => choose(page, "files", join(native.folder, "tour/lamp.gltf")), () =>
      chooseFolder(one, page, native.folder)]) {
      await choice();
      const [[, buttons], [list]] = await places(page, "#downloads", "#list");
      assert.ok(list - buttons >= 16, `${width} px: ${list - buttons} px between buttons and assets`);
    }
    await unfold(page);
    const [[findings], [facts, factsEnd]] = await places(page, ".asset .findings", ".asset .fact-side");
    assert.ok(width > 960 ? findings < factsEnd : findings < facts, `${width} px: facts come first`);
    await page.close();
  }
}

/** Presses Tab until something has the focus that `words` select. */
async function tabTo(page, words) {
  for (let i = 0; i < 30; ++i) {
    await page.keyboard.press("Tab");
    if (await page.evaluate((selector) => document.activeElement.matches(selector), words)) return;
  }
  assert.fail(`Tab does not reach ${words}`);
}

async function worksByKeyboard(one, url, native) {
  const page = await open(one, url);
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Skip to the content");
  for (const [button, field] of [
    ["choose-files", "files"],
    ["choose-folder", "folder"],
  ]) {
    await page.evaluate(
      (id) =>
        document.getElementById(id).addEventListener(
          "click",
          (event) => {
            event.preventDefault(); // no window of the system
            window.asked = id;
          },
          { once: true },
        ),
      field,
    );
    await tabTo(page, `#${button}`);
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => window.asked), field);
  }
  await chooseFolder(one, page, native.folder);
  await tabTo(page, "#get-html");
  await tabTo(page, "#filter input");
  await page.keyboard.press("ArrowRight");
  assert.equal((await page.$$("#list > li")).length, 3, "assets with errors");
  await tabTo(page, "#list summary");
  const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
  assert.equal(outline, "solid");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#list details[open] .finding");
  await tabTo(page, ".excerpt");
  await page.close();
}

async function followsTheSystem(one, url) {
  if (one.name !== "chromium") return; // only its debugger sets system preferences
  const page = await open(one, url);
  const paper = async (value) => {
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value }]);
    return page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  };
  assert.equal(await paper("light"), "rgb(251, 250, 248)");
  assert.equal(await paper("dark"), "rgb(21, 23, 26)");
  await page.close();
}

/** [name, check] */
export function accessChecks(one, url, native, axeSource) {
  return [
    ["accessible in both themes, at 1280 and 360 px", () => isAccessible(one, url, native, axeSource)],
    ["laid out at 1280 and 390 px", () => isLaidOut(one, url, native)],
    ["works by keyboard", () => worksByKeyboard(one, url, native)],
    ["light and dark as the system", () => followsTheSystem(one, url)],
  ];
}

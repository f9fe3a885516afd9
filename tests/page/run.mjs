// SPDX-License-Identifier: Apache-2.0
// The report page, and that of a comparison, before a checker of HTML and in a browser.
//
//   node run.mjs PROGRAM MODULES [--speed]
//
// MODULES is a node_modules with html-validate, playwright-core and axe-core. The browser is
// `chromium`, or the program in the environment's CHROMIUM; without one, its checks are skipped.
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { browserChecks } from "./browser_checks.mjs";
import { compareChecks, writePairs } from "./compare.mjs";
import { writeHostile } from "./hostile.mjs";
import { withRequirements } from "./requirements.mjs";
import { speedChecks } from "./speed.mjs";

const [program, modules, ...words] = process.argv.slice(2);
const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const require = createRequire(join(resolve(modules), "nothing.js"));
const folder = mkdtempSync(join(tmpdir(), "gltfx_page_"));
const page = join(folder, "report.html");
const compared = join(folder, "compare.html");

function write(...options) {
  const done = spawnSync(resolve(program), ["report", ...options, "--quiet", "--fail-on", "never"], { cwd: root });
  if (done.error || done.status !== 0) throw new Error(`gltfx report: ${done.stderr}`);
}

function compare() {
  const words = ["compare", ...writePairs(folder), "-o", compared, "--size", "64"];
  const done = spawnSync(resolve(program), words, { cwd: root });
  if (done.error || done.status !== 1) throw new Error(`gltfx compare: ${done.stderr}`);
}

function validateHtml(file) {
  const tool = join(resolve(modules), ".bin", "html-validate");
  execFileSync(tool, ["--config", join(root, "tests/page/html-validate.json"), file], { stdio: "inherit" });
}

async function startBrowser() {
  const name = process.env.CHROMIUM || "chromium";
  const found = spawnSync("sh", ["-c", 'command -v "$0"', name], { encoding: "utf8" }).stdout.trim();
  if (!found) return null;
  const { chromium } = require("playwright-core");
  return chromium.launch({ executablePath: found, args: ["--no-sandbox", "--disable-gpu"] });
}

async function main() {
  const speed = words.includes("--speed");
  let failed = 0;
  const check = async ([name, run]) => {
    try {
      await run();
      console.log(`ok: ${name}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED: ${name}\n${error.message}`);
    }
  };
  const pictures = speed ? ["--thumbnail-size", "96"] : ["--no-thumbnails"];
  write("fixtures", writeHostile(folder), "-o", page, "--target", "three,blender,babylon", ...pictures);
  compare();
  await check(["valid HTML", () => validateHtml(page)]);
  await check(["valid HTML of a comparison", () => validateHtml(compared)]);
  const browser = await startBrowser();
  if (browser === null) {
    console.log("skipped: chromium is not installed, so that the page is not opened");
  } else {
    const limits = join(folder, "limits.html");
    writeFileSync(limits, withRequirements(readFileSync(page, "utf8")));
    const checks = browserChecks(browser, pathToFileURL(page).href, pathToFileURL(limits).href, require.resolve("axe-core"));
    for (const one of checks) await check(one);
    const axeSource = readFileSync(require.resolve("axe-core"), "utf8");
    for (const one of compareChecks(browser, pathToFileURL(compared).href, axeSource)) await check(one);
    const large = join(folder, "large.html");
    if (speed) for (const one of speedChecks(browser, page, large, pathToFileURL(large).href)) await check(one);
    await browser.close();
  }
  return failed;
}

let failed = 1;
try {
  failed = await main();
} finally {
  rmSync(folder, { recursive: true, force: true });
}
process.exitCode = failed === 0 ? 0 : 1;

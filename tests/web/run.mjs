// SPDX-License-Identifier: Apache-2.0
// The page of tools/web in browsers, compared with the native program.
//
//   node run.mjs PROGRAM MODULES ENGINE_FOLDER
//
// MODULES is a node_modules with puppeteer-core, axe-core and html-validate; ENGINE_FOLDER has gltfx.wasm.
// The browsers are `chromium` and `firefox-esr`, or the programs in the environment's CHROMIUM and FIREFOX.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { accessChecks } from "./access_checks.mjs";
import { startBrowsers } from "./browsers.mjs";
import { Assets, resultChecks } from "./result_checks.mjs";
import { safetyChecks } from "./safety_checks.mjs";

const [program, modules, engine] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, "../..");
const require = createRequire(join(resolve(modules), "nothing.js"));
const place = mkdtempSync(join(tmpdir(), "gltfx_web_"));
const page = join(place, "gltfx.html");

function validateHtml() {
  execFileSync(
    join(resolve(modules), ".bin", "html-validate"),
    ["--config", join(root, "tests/page/html-validate.json"), page],
    { stdio: "inherit" },
  );
}

async function main() {
  let failed = 0;
  const check = async (name, run) => {
    try {
      await run();
      console.log(`ok: ${name}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED: ${name}\n${error.stack}`);
    }
  };
  execFileSync(join(root, "tools/web/assemble"), [engine, page], { stdio: "inherit" });
  await check("valid HTML", validateHtml);
  const { default: puppeteer } = await import(pathToFileURL(require.resolve("puppeteer-core")).href);
  const url = pathToFileURL(page).href;
  const native = new Assets(resolve(program), root, place);
  for (const one of await startBrowsers(puppeteer, place)) {
    const checks = [
      ...resultChecks(one, url, native),
      ...safetyChecks(one, url, page, native),
      ...accessChecks(one, url, native, readFileSync(require.resolve("axe-core"), "utf8")),
    ];
    for (const [name, run] of checks) await check(`${one.name}: ${name}`, run);
    await one.browser.close();
  }
  return failed;
}

let failed = 1;
try {
  failed = await main();
} finally {
  rmSync(place, { recursive: true, force: true });
}
process.exitCode = failed === 0 ? 0 : 1;

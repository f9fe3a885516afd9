// SPDX-License-Identifier: Apache-2.0
// Reports on assets: fixtures, GLTFX_CORPUS, and `gltf-transform validate` with the validator swapped.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { test } from "node:test";
import {
  archive,
  assetsBelow,
  comparable,
  importFrom,
  install,
  modules,
  optionsFor,
  outcomeOf,
  peer,
  root,
  temporaryFolder,
} from "./packages.mjs";

const ours = await importFrom(install({ native: false }), "gltfx/compat.mjs");
const corpus = process.env.GLTFX_CORPUS;
const leastAlike = 0.98;
const stride = Number(process.env.GLTFX_CORPUS_STRIDE ?? 1); // gltf-transform is slow

async function bothSay(path) {
  const both = await Promise.all(
    [peer, ours].map(async (validator) => {
      const calls = [];
      const bytes = new Uint8Array(readFileSync(path));
      const outcome = await outcomeOf(() => validator.validateBytes(bytes, optionsFor(path, calls)));
      return { calls, ...outcome, report: outcome.report && comparable(outcome.report) };
    }),
  );
  return both;
}

function areAlike(expected, found) {
  try {
    assert.deepEqual(found, expected);
    return true;
  } catch {
    return false;
  }
}

test("reports on fixtures are the same", async () => {
  const paths = assetsBelow("fixtures", "tests/golden/cases");
  assert.ok(paths.length > 100);
  const differing = [];
  for (const path of paths) {
    const [expected, found] = await bothSay(path);
    if (!areAlike(expected, found)) differing.push(relative(root, path));
  }
  assert.deepEqual(differing, []);
});

test("reports on a corpus", { skip: corpus ? false : "GLTFX_CORPUS is not set" }, async () => {
  const paths = assetsBelow(corpus);
  const differing = [];
  for (const path of paths) {
    const [expected, found] = await bothSay(path);
    if (!areAlike(expected, found)) differing.push(path);
  }
  const alike = paths.length - differing.length;
  console.log(`${alike} of ${paths.length} reports are the same; not:\n  ${differing.join("\n  ")}`);
  assert.ok(alike >= leastAlike * paths.length);
});

// The table of gltf-transform as CSV: codes, severities and pointers; the words of messages are our own.
function transform(folder, path) {
  const program = join(folder, "node_modules/@gltf-transform/cli/bin/cli.js");
  return new Promise((done) => {
    const child = spawn("node", [program, "validate", path, "--format", "csv"], {
      stdio: ["ignore", "pipe", "ignore"],
    });
    let text = "";
    child.stdout.on("data", (part) => (text += part));
    child.on("close", (code) => {
      const rows = text.split("\n").filter((line) => /^[A-Z_0-9]+,/.test(line));
      done({
        code,
        rows: rows.map((row) => [row.split(",")[0], /,([0-3]),([^,]*)$/.exec(row)?.slice(1)].flat().join()),
      });
    });
  });
}

test("gltf-transform with the validator swapped by `overrides`", async (t) => {
  if (!existsSync(join(modules, "@gltf-transform/cli")))
    return t.skip("@gltf-transform/cli is not installed");
  const folder = temporaryFolder();
  const { version } = JSON.parse(readFileSync(join(modules, "@gltf-transform/cli/package.json")));
  writeFileSync(
    join(folder, "package.json"),
    JSON.stringify({
      name: "user",
      private: true,
      dependencies: { "@gltf-transform/cli": version },
      overrides: { "gltf-validator": `file:${archive}` },
    }),
  );
  execFileSync("npm", ["install", "--offline", "--no-audit", "--no-fund"], { cwd: folder, stdio: "pipe" });
  assert.equal(
    JSON.parse(readFileSync(join(folder, "node_modules/gltf-validator/package.json"))).name,
    "gltfx",
  );
  const differing = [];
  const paths = corpus
    ? assetsBelow(corpus).filter((_, at) => at % stride === 0)
    : assetsBelow("fixtures/good", "tests/golden/cases").slice(0, 20);
  for (const path of paths) {
    const [expected, found] = await Promise.all(
      [join(modules, ".."), folder].map((place) => transform(place, path)),
    );
    if (!areAlike(expected, found)) differing.push(path);
  }
  const alike = paths.length - differing.length;
  console.log(`${alike} of ${paths.length} outputs are the same; not:\n  ${differing.join("\n  ")}`);
  assert.ok(differing.length <= (1 - leastAlike) * paths.length);
});

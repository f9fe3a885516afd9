// SPDX-License-Identifier: Apache-2.0
// node tests/wasm/run.mjs PROGRAM ENGINE_FOLDER FOLDER...
// Reports of the engine in WebAssembly are those of the program, byte for byte, for each asset below the
// folders: in the profile khronos those of validate(), by default those of the command line.
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

import { createEngine } from "../../tools/npm/wasm/engine.mjs";

const [program, engineFolder, ...folders] = process.argv.slice(2).map((path) => resolve(path));
const loader = (await import(pathToFileURL(join(engineFolder, "gltfx-wasm.mjs")))).default;
const engine = await createEngine(readFileSync(join(engineFolder, "gltfx.wasm")), loader);

const OPTIONS = {
  khronos: ["--profile", "khronos", "--format", "khronos"],
  default: ["--format", "json"],
};

function assetsBelow(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile() && /\.(gltf|glb|vrm)$/.test(entry.name))
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
    .sort();
}

function argumentsFor(name, profile) {
  return ["validate", "--isolated", "--fail-on", "never", ...OPTIONS[profile], "--", name];
}

function reportOfProgram(folder, name, profile) {
  return execFileSync(program, argumentsFor(name, profile), { cwd: folder, encoding: "utf8", maxBuffer: 1 << 30 });
}

// The file of a URI in reports, which is percent-encoded; null when there is none.
function resource(folder, uri) {
  try {
    return readFileSync(join(folder, decodeURIComponent(uri)));
  } catch {
    return null;
  }
}

// Only a command line has folders, and URIs that lead out of one.
function isPlain(uri) {
  return uri !== "" && !decodeURIComponent(uri).split("/").includes("..");
}

async function resourcesOf(folder, name, options) {
  const asset = readFileSync(join(folder, name));
  const resources = new Map();
  while (true) {
    const { report, missing } = engine.validate(asset, { ...options, resources });
    if (missing.length === 0) return { asset, resources, report };
    for (const uri of missing) resources.set(uri, isPlain(uri) ? resource(folder, uri) : null);
  }
}

async function reportOfEngine(folder, name, profile) {
  const { asset, resources, report } = await resourcesOf(folder, name, { uri: name, profile });
  if (profile === "khronos" && [...resources.keys()].every(isPlain)) return report;
  const files = new Map([[name, asset]]);
  for (const [uri, bytes] of resources) {
    if (bytes !== null) files.set(decodeURIComponent(uri), bytes);
  }
  const { stdout } = await engine.run(argumentsFor(name, profile), files);
  return new TextDecoder().decode(stdout);
}

let equal = 0;
const different = [];
for (const path of folders.flatMap(assetsBelow)) {
  for (const profile of ["khronos", "default"]) {
    const [folder, name] = [dirname(path), path.slice(dirname(path).length + 1)];
    const theirs = reportOfProgram(folder, name, profile);
    const ours = await reportOfEngine(folder, name, profile).catch((error) => `${error}`);
    if (ours === theirs) equal += 1;
    else different.push(`${profile} ${path}`);
    if (different.length === 1 && process.env.SHOW) {
      console.log(theirs.slice(0, 2000), "\n----\n", ours.slice(0, 2000));
      process.exit(1);
    }
  }
}
for (const line of different.slice(0, 20)) console.log(`differs: ${line}`);
console.log(`${equal} passed, ${different.length} failed`);
process.exitCode = different.length === 0 && equal > 0 ? 0 : 1;

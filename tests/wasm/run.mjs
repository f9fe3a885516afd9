// SPDX-License-Identifier: Apache-2.0
// node tests/wasm/run.mjs PROGRAM ENGINE_FOLDER FOLDER...
// Reports of the engine in WebAssembly are those of the program, byte for byte, for each asset below the
// folders, in the profiles khronos and default.
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { pathToFileURL } from "node:url";

import { createEngine } from "../../tools/npm/engine.mjs";

const [program, engineFolder, ...folders] = process.argv.slice(2).map((path) => resolve(path));
const loader = (await import(pathToFileURL(join(engineFolder, "gltfx-wasm.mjs")))).default;
const engine = await createEngine(readFileSync(join(engineFolder, "gltfx-wasm.wasm")), loader);

const OPTIONS = {
  khronos: ["--profile", "khronos", "--format", "khronos"],
  default: ["--format", "json"],
};

function assetsBelow(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile() && /\.(gltf|glb)$/.test(entry.name))
    .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
    .sort();
}

function reportOfProgram(folder, name, profile) {
  const args = ["validate", "--isolated", "--fail-on", "never", ...OPTIONS[profile], "--", name];
  return execFileSync(program, args, { cwd: folder, encoding: "utf8", maxBuffer: 1 << 30 });
}

// The file behind a URI of reports, which is percent-encoded; null when there is none inside the folder.
function resource(folder, uri) {
  if (uri === "") throw new Error("folder"); // which functions that give bytes do not know
  try {
    const path = join(folder, decodeURIComponent(uri));
    return relative(folder, path).startsWith("..") ? null : readFileSync(path);
  } catch {
    return null;
  }
}

async function reportOfEngine(folder, name, profile) {
  const resources = new Map();
  while (true) {
    const { report, missing } = await engine.validate(readFileSync(join(folder, name)), {
      uri: name,
      profile,
      resources,
    });
    if (missing.length === 0) return report;
    for (const uri of missing) resources.set(uri, resource(folder, uri));
  }
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

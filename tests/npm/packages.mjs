// SPDX-License-Identifier: Apache-2.0
// Installs the archives of build/npm-package without a network; finds fixtures and the other validator.
//
//   GLTFX_PEER    node_modules with gltf-validator, @gltf-transform/cli and typescript (build/npm)
//   GLTFX_CORPUS  a folder of more assets, each compared with the report of gltf-validator
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
export const modules = resolve(process.env.GLTFX_PEER ?? join(root, "build/npm/node_modules"));
export const version = /^project\(gltfx VERSION ([0-9.]+)/m.exec(
  readFileSync(join(root, "CMakeLists.txt")),
)[1];
const archives = join(root, "build/npm-package");
export const archive = join(archives, `gltfx-${version}.tgz`);
const folders = [];
process.on("exit", () => folders.forEach((folder) => rmSync(folder, { recursive: true, force: true })));

export function temporaryFolder() {
  folders.push(mkdtempSync(join(tmpdir(), "gltfx_npm_")));
  return folders.at(-1);
}

/** A project with the package, and with or without the native program. */
export function install({ native }) {
  const folder = temporaryFolder();
  const dependencies = { gltfx: `file:${archive}` };
  if (native) dependencies["@gltfx/linux-x64"] = `file:${join(archives, `gltfx-linux-x64-${version}.tgz`)}`;
  writeFileSync(join(folder, "package.json"), JSON.stringify({ name: "user", private: true, dependencies }));
  const words = ["install", "--offline", "--no-audit", "--no-fund", "--registry", "http://127.0.0.1:9/"];
  execFileSync("npm", native ? words : [...words, "--omit=optional"], { cwd: folder, stdio: "pipe" });
  return folder;
}

export function requireFrom(folder) {
  return createRequire(join(folder, "user.cjs"));
}

export function importFrom(folder, path) {
  return import(pathToFileURL(join(folder, "node_modules", path)));
}

export const peer = requireFrom(dirname(modules))("gltf-validator");

export function command(folder, args, options = {}) {
  const done = spawnSync(join(folder, "node_modules/.bin/gltfx"), args, { cwd: root, ...options });
  return { code: done.status, stdout: done.stdout.toString(), stderr: done.stderr.toString() };
}

function below(folder) {
  return readdirSync(folder)
    .sort()
    .flatMap((name) => {
      const path = join(folder, name);
      return statSync(path).isDirectory() ? below(path) : [path];
    });
}

export function assetsBelow(...names) {
  return names.flatMap((name) => below(resolve(root, name))).filter((path) => /\.(gltf|glb|vrm)$/i.test(path));
}

/** Reads the resources of an asset, as users of gltf-validator do. */
export function loaderFor(path, calls = []) {
  return async (uri) => {
    calls.push(uri);
    return new Uint8Array(readFileSync(resolve(dirname(path), decodeURIComponent(uri))));
  };
}

/** Options for one asset, the same for both validators. */
export function optionsFor(path, calls) {
  const format = path.toLowerCase().endsWith(".glb") ? "glb" : "gltf";
  const externalResourceFunction = loaderFor(path, calls);
  return { uri: basename(path), format, maxIssues: 0, writeTimestamp: false, externalResourceFunction };
}

/** A report without what differs on purpose: the words of messages and the version. */
export function comparable({ validatorVersion, issues, ...rest }) {
  const messages = issues.messages.map(({ message, ...place }) => place);
  return { ...rest, issues: { ...issues, messages } };
}

/** What came of a call: a report, or the class of the error. */
export async function outcomeOf(call) {
  try {
    const promise = call();
    if (!(promise instanceof Promise)) return { returned: typeof promise };
    return { report: await promise };
  } catch (error) {
    return { rejected: typeof error, text: String(error) };
  }
}

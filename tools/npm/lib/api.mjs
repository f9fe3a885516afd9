// SPDX-License-Identifier: Apache-2.0
// validate(), upgrade() and inspect() over bytes.
import { isBytes } from "./compat_options.mjs";

function checkArguments(asset, options) {
  if (!isBytes(asset)) throw new TypeError("gltfx: the asset must be a Uint8Array");
  if (options === null || typeof options !== "object")
    throw new TypeError("gltfx: options must be an object");
  const { resources } = options;
  const isSource = resources === undefined || typeof resources === "function" || resources instanceof Map;
  if (!isSource) throw new TypeError("gltfx: options.resources must be a Map or a function");
}

async function load(source, uri) {
  if (source instanceof Map) return source.get(uri) ?? null;
  const bytes = await Promise.resolve(source(uri)).catch(() => null); // cannot be had
  if (bytes === null || bytes === undefined) return null;
  if (!isBytes(bytes)) throw new TypeError(`gltfx: options.resources gave no Uint8Array for '${uri}'`);
  return bytes;
}

/** Validates until the engine has all resources that can be had. */
async function validateAll(engine, asset, { resources: source, ...options }) {
  const resources = new Map();
  for (;;) {
    while (!engine.isReady) await engine.start();
    const answer = engine.validate(asset, { ...options, resources });
    const wanted = source === undefined ? [] : answer.missing.filter((uri) => !resources.has(uri));
    if (wanted.length === 0) return { report: JSON.parse(answer.report), resources };
    for (const uri of new Set(wanted)) resources.set(uri, await load(source, uri));
  }
}

// Where a program finds a resource beside the asset; null: nowhere there.
function pathOf(uri) {
  const text = uri.replace(/[?#][^]*$/, "");
  let path = text;
  try {
    path = decodeURIComponent(text);
  } catch {
    // stands for itself
  }
  const leavesFolder = path.split(/[/\\]/).includes("..") || /^([/\\]|[A-Za-z]:)/.test(path);
  return path === "" || leavesFolder ? null : path;
}

async function runOver(engine, asset, options, words) {
  const { resources } = await validateAll(engine, asset, { resources: options.resources });
  const name = asset[0] === 0x67 ? "asset.glb" : "asset.gltf";
  const files = new Map();
  for (const [uri, bytes] of resources) {
    const path = pathOf(uri);
    if (path !== null && bytes !== null) files.set(path, bytes);
  }
  files.set(name, asset);
  const [verb, ...rest] = words;
  const done = await engine.run([verb, name, "--isolated", "--format", "json", ...rest], files);
  if (done.code === 2 || done.code === 4 || done.stdout.length === 0) {
    throw new Error(done.stderr.trim() || `gltfx ${verb} ended with ${done.code}`);
  }
  return { report: JSON.parse(new TextDecoder().decode(done.stdout)), files: done.files, name };
}

function wordsOfUpgrade({ unsafe, strict, prune, only = [], to = [] }) {
  const words = ["--in-place"];
  if (unsafe) words.push("--unsafe");
  if (strict) words.push("--strict");
  if (prune) words.push("--prune");
  for (const name of only) words.push("--only", name);
  for (const name of to) words.push("--to", name);
  return words;
}

export function createApi(getEngine) {
  return {
    async validate(asset, options = {}) {
      checkArguments(asset, options);
      const { report } = await validateAll(await getEngine(), asset, options);
      return report.files?.[0] ?? report; // the report of a run has a list of files
    },
    async upgrade(asset, options = {}) {
      checkArguments(asset, options);
      const words = ["upgrade", ...wordsOfUpgrade(options)];
      const { report, files, name } = await runOver(await getEngine(), asset, options, words);
      const [done] = report.files;
      if (done.problem === "unreadable") throw new Error(done.error);
      const upgraded = files.get(name) ?? asset;
      files.delete(name);
      return { asset: upgraded, files, report: done };
    },
    async inspect(asset, options = {}) {
      checkArguments(asset, options);
      const { report } = await runOver(await getEngine(), asset, options, ["inspect", "--top", "0"]);
      const [found] = report.assets;
      if (found.facts === undefined) throw new Error(found.error);
      return found.facts;
    },
  };
}

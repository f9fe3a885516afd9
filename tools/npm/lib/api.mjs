// SPDX-License-Identifier: Apache-2.0
// validate(), fix(), upgrade(), edit(), convert(), compare() and inspect() on bytes.
import { checkAreCodes, checkOptions } from "./api_options.mjs";
import { isBytes } from "./compat_options.mjs";

// On Windows, a path with a drive leads out of any folder.
const namesDrive = (path) => /^[A-Za-z]:/.test(path);

async function ask(source, path) {
  try {
    return namesDrive(path) ? null : await source(path);
  } catch {
    return null; // missing
  }
}

async function load(source, path) {
  const bytes = source instanceof Map ? source.get(path) : await ask(source, path);
  if (bytes === null || bytes === undefined) return null;
  if (!isBytes(bytes)) throw new TypeError(`gltfx: options.resources gave no Uint8Array for '${path}'`);
  return bytes;
}

/** Repeats the validation until the engine has all available resources. */
async function validateAll(engine, asset, { resources: source, ...options }) {
  const resources = new Map();
  for (;;) {
    while (!engine.isReady) await engine.start();
    const answer = engine.validate(asset, { ...options, paths: true, resources });
    const wanted = source === undefined ? [] : answer.missing.filter((path) => !resources.has(path));
    if (wanted.length === 0) return { report: JSON.parse(answer.report), resources };
    for (const path of new Set(wanted)) resources.set(path, await load(source, path));
  }
}

/** Adds an asset and what it refers to below a folder. Returns its name. */
async function addFiles(engine, asset, source, files, folder = "") {
  const { resources } = await validateAll(engine, asset, { resources: source });
  const name = `${folder}asset.${asset[0] === 0x67 ? "glb" : "gltf"}`;
  for (const [path, bytes] of resources) if (bytes !== null) files.set(folder + path, bytes);
  files.set(name, asset);
  return name;
}

async function run(engine, names, files, [verb, ...rest]) {
  const done = await engine.run([verb, ...names, "--isolated", "--format", "json", ...rest], files);
  if (done.code === 2 || done.code === 4 || done.stdout.length === 0) {
    throw new Error(done.stderr.trim() || `gltfx ${verb} ended with ${done.code}`);
  }
  return { report: JSON.parse(new TextDecoder().decode(done.stdout)), files: done.files };
}

async function runOver(engine, asset, options, words) {
  const files = new Map();
  const name = await addFiles(engine, asset, options.resources, files);
  return { ...(await run(engine, [name], files, words)), name };
}

const repeated = (word, values = []) => values.flatMap((value) => [word, value]);
const flags = (options, names) => names.filter((name) => options[name]).map((name) => `--${name}`);

/** The words of a verb that changes an asset, by its options. */
const WORDS = {
  fix: (options) => [
    ...flags(options, ["unsafe"]),
    ...(options.profile ? ["--profile", options.profile] : []),
    ...repeated("--only", options.only),
    ...repeated("--skip", options.skip),
  ],
  upgrade: (options) => [
    ...flags(options, ["unsafe", "strict", "prune"]),
    ...repeated("--only", options.only),
    ...repeated("--to", options.to),
  ],
  edit: (options) => [...flags(options, ["cascade"]), ...repeated("--delete", options.delete)],
};

const STEPS = ["dedup", "prune", "weld", "reorder", "resample", "shrink", "partial"];
const FOLDER = "out/"; // of the new asset: in place, it would keep its container

async function convert(engine, asset, options) {
  const isBinary = (options.to ?? (asset[0] === 0x67 ? "glb" : "gltf")) === "glb";
  const output = `${FOLDER}asset.${isBinary ? "glb" : "gltf"}`;
  const words = ["convert", "-o", output, ...flags(options, STEPS)];
  if (options.to) words.push("--to", options.to);
  if (options.compress) words.push("--compress", options.compress);
  const { report, files } = await runOver(engine, asset, options, words);
  const [done] = report.files;
  if (done.problem === "unreadable") throw new Error(done.error);
  const changed = files.get(output) ?? asset;
  const others = [...files].filter(([path]) => path.startsWith(FOLDER) && path !== output);
  return {
    asset: changed,
    files: new Map(others.map(([path, bytes]) => [path.slice(FOLDER.length), bytes])),
    report: done,
  };
}

async function compare(engine, before, after, options) {
  const files = new Map();
  const { oldResources = options.resources, newResources = options.resources } = options;
  const names = [
    await addFiles(engine, before, oldResources, files, "old/"),
    await addFiles(engine, after, newResources, files, "new/"),
  ];
  const words = ["compare", ...flags(options, ["drawn"]), ...(options.bounds ? [`--bounds=${options.bounds}`] : [])];
  words.push(...repeated("--ignore", options.ignore), ...repeated("--count", options.count));
  const { report } = await run(engine, names, files, words);
  const { error, level, changes, storage, unproven } = report.pairs[0];
  if (error !== undefined) throw new Error(error);
  return { level, changes, storage, unproven };
}

/** A function that runs a verb over bytes and gives the new ones. */
function changing(getEngine, verb) {
  return async (asset, options = {}) => {
    const known = checkOptions(verb, asset, options);
    const words = [verb, "--in-place", ...WORDS[verb](known)];
    const { report, files, name } = await runOver(await getEngine(), asset, known, words);
    const [done] = report.files;
    if (done.problem === "unreadable") throw new Error(done.error);
    const changed = files.get(name) ?? asset;
    files.delete(name);
    return { asset: changed, files, report: done };
  };
}

export function createApi(getEngine) {
  return {
    async validate(asset, options = {}) {
      const known = checkOptions("validate", asset, options);
      const engine = await getEngine();
      while (!engine.isReady) await engine.start();
      checkAreCodes(engine, known);
      const { report } = await validateAll(engine, asset, known);
      return report.files?.[0] ?? report; // the report of a run has a list of files
    },
    fix: changing(getEngine, "fix"),
    upgrade: changing(getEngine, "upgrade"),
    edit: changing(getEngine, "edit"),
    async convert(asset, options = {}) {
      return convert(await getEngine(), asset, checkOptions("convert", asset, options));
    },
    async compare(before, after, options = {}) {
      checkOptions("compare", after, options);
      return compare(await getEngine(), before, after, checkOptions("compare", before, options));
    },
    async inspect(asset, options = {}) {
      const known = checkOptions("inspect", asset, options);
      const { report } = await runOver(await getEngine(), asset, known, ["inspect", "--top", "0"]);
      const [found] = report.assets;
      if (found.facts === undefined) throw new Error(found.error);
      return found.facts;
    },
  };
}

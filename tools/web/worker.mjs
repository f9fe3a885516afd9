// SPDX-License-Identifier: Apache-2.0
// Checks dropped files in a worker. The page ends the worker to stop it. The loader of the engine comes from the folder
// of its build.
//
//   in   {open: [{path, file}], wasm}            out  {assets, leftOut}, {asset, rules}..., {checked: true}
//   in   {make: "html" | "sarif" | "fixed" | "upgraded" | "packed"}  out  {made: Blob, name, failed} or {made: null, why}
//   in   {make: "compared"}                      out  {compared: text} or {made: null, why}
import { createEngine } from "../npm/wasm/engine.mjs";
import loader from "gltfx-wasm.mjs";
import { isFixable, nameOfGlb, toUpgrade } from "./assets.mjs";
import { compareTexts } from "./comparison.mjs";
import { groupsOf, openFolder, Reading } from "./files.mjs";
import { writeZip } from "./zip.mjs";

const COMMON = ["--isolated", "--quiet"];
let engine = null;
let folder = null;
const toChange = { fix: [], upgrade: [] }; // paths of assets by verb

/**
 * Runs a verb on assets and returns the files that it wrote. Options come from `options(place)`; `earlier` are files
 * that other runs wrote.
 */
async function run(verb, paths, options, earlier = new Map()) {
  const reading = new Reading(folder.files);
  for (const path of paths) await reading.addAsset(path);
  addNewFiles(reading.content, earlier);
  let place = "gltfx-page"; // of files that are not the user's
  while ([...reading.content.keys()].some((path) => path.startsWith(place))) place += "_";
  const list = `${place}/assets`;
  reading.content.set(list, new TextEncoder().encode(paths.map((path) => `${path}\0`).join("")));
  const done = await engine.run([verb, "--files-from", list, ...COMMON, ...options(place)], reading.content);
  if (done.code > 1) throw new Error(done.stderr.trim() || `gltfx ${verb} ended with code ${done.code}`);
  return { written: done.files, place, said: done.stderr.trim() };
}

const folderOf = (path) => path.slice(0, path.lastIndexOf("/") + 1);

/** Adds new files that are in a folder of the content: their names are taken. */
function addNewFiles(content, files) {
  const folders = new Set([...content.keys()].map(folderOf));
  for (const [path, bytes] of files) {
    if (!folder.files.has(path) && folders.has(folderOf(path))) content.set(path, bytes);
  }
}

async function writePage(paths, title) {
  const done = await run("report", paths, (place) => [
    "-o",
    `${place}/report.html`,
    "--no-thumbnails",
    "--fail-on",
    "never",
    `--title=${title}`,
  ]);
  return done.written.get(`${done.place}/report.html`);
}

/** The data of a report page: findings, excerpts, facts and upgrades of its assets. */
function dataOf(page) {
  const html = new TextDecoder().decode(page);
  const begin = html.indexOf(">", html.indexOf('<script id="data"')) + 1;
  return JSON.parse(html.slice(begin, html.indexOf("</script>", begin)));
}

/** The entry of an asset that was not given to the engine, or that made it fail. */
const unchecked = (path, why) => ({
  path,
  why,
  readable: false,
  findings: [],
  upgrade: [],
  counts: { errors: 0, warnings: 0, infos: 0, hints: 0 },
});

async function check(path) {
  try {
    const {
      assets: [asset],
      rules,
    } = dataOf(await writePage([path], path));
    if (isFixable(asset)) toChange.fix.push(path);
    if (toUpgrade(asset) > 0) toChange.upgrade.push(path);
    return { asset, rules };
  } catch (error) {
    return { asset: unchecked(path, error.message), rules: {} };
  }
}

async function open(dropped, wasm) {
  folder = await openFolder(dropped);
  postMessage({ assets: folder.assets, leftOut: folder.leftOut });
  if (folder.assets.length > 0) engine = await createEngine(wasm, loader);
  for (const path of folder.assets) postMessage(await check(path));
  postMessage({ checked: true });
}

// --- Downloads ---

async function change(verb, name) {
  const written = new Map();
  // Assets that share files need one run, which knows that. All in one could need too much memory.
  for (const paths of await groupsOf(folder.files, toChange[verb])) {
    const done = await run(verb, paths, () => ["--in-place"], written);
    for (const [path, bytes] of done.written) written.set(path, bytes);
  }
  if (written.size === 0) throw new Error("no file changes");
  return filesOf([...written], name);
}

function filesOf(files, name) {
  if (files.length > 1) return { made: writeZip(files), name: `${name}.zip` };
  return { made: new Blob([files[0][1]]), name: files[0][0].split("/").pop() };
}

/** Adds a GLB. With files that it refers to, it gets a folder of its own. */
function addPacked(files, path, { written, place, said }) {
  const made = [...written].filter(([one]) => one.startsWith(`${place}/packed/`));
  const glb = made.map(([one]) => one).find((one) => /\.(glb|vrm)$/.test(one));
  if (glb === undefined) throw new Error(said || "it cannot be packed");
  const name = nameOfGlb(path, files);
  const above = glb.slice(0, glb.lastIndexOf("/") + 1);
  const others = made.filter(([one]) => one !== glb);
  const own = others.length > 0 ? `${name.slice(0, -".glb".length)}/` : "";
  files.set(own + (own ? name.split("/").pop() : name), written.get(glb));
  for (const [one, bytes] of others) files.set(own + one.slice(above.length), bytes);
}

/** One GLB of each asset, as small as it becomes without loss. */
async function pack() {
  const files = new Map();
  const failed = [];
  for (const path of folder.assets) {
    try {
      const done = await run("convert", [path], (place) => ["-o", `${place}/packed/`, "--to", "glb", "--shrink"]);
      addPacked(files, path, done);
    } catch (error) {
      failed.push(`${path}: ${error.message}`);
    }
  }
  if (files.size === 0) throw new Error(failed[0] ?? "no asset can be packed");
  return { ...filesOf([...files], "packed"), failed };
}

const MAKERS = {
  html: async (title) => ({
    made: new Blob([await writePage(folder.assets, title)], { type: "text/html" }),
    name: "gltfx-report.html",
  }),
  sarif: async () => {
    const done = await run("validate", folder.assets, (place) => [
      "--fail-on",
      "never",
      "--format",
      `sarif=${place}/log.sarif`,
    ]);
    return {
      made: new Blob([done.written.get(`${done.place}/log.sarif`)], { type: "application/sarif+json" }),
      name: "gltfx.sarif",
    };
  },
  fixed: () => change("fix", "fixed"),
  upgraded: () => change("upgrade", "upgraded"),
  packed: pack,
  compared: async () => ({ compared: await compareTexts(engine, folder.files, folder.assets) }),
};

async function make(kind, title) {
  try {
    postMessage(await MAKERS[kind](title));
  } catch (error) {
    postMessage({ made: null, why: error.message });
  }
}

addEventListener("message", ({ data }) => {
  if (data.open) open(data.open, data.wasm).catch((error) => postMessage({ broken: error.message }));
  else make(data.make, data.title);
});

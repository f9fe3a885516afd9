// SPDX-License-Identifier: Apache-2.0
// Dropped files by path: the assets, and the files that an asset needs.
import { readZip } from "./zip.mjs";

const MOST_FILES = 100000;
const MOST_BYTES = 2 ** 30; // limit of one run of the engine
const LONGEST_NAME = 255;
const LONGEST_PATH = 4000;
const GLB_MAGIC = 0x46546c67;

/** Why a path cannot be used; empty: it can. */
export function pathProblem(path) {
  const names = path.split("/");
  if (/[\0\\]/.test(path) || names.some((name) => name === "" || name === "." || name === "..")) {
    return "its path could lead out of the folder";
  }
  const size = (text) => new TextEncoder().encode(text).length;
  return size(path) > LONGEST_PATH || names.some((name) => size(name) > LONGEST_NAME)
    ? "its name is too long"
    : "";
}

const isAsset = (path) => /\.(gltf|glb|vrm)$/i.test(path);
const isZip = (path) => /^[^/]*\.zip$/i.test(path);
const isOtherArchive = (path) => /^[^/]*\.(7z|bz2|gz|rar|tar|tgz|xz|zst)$/i.test(path);

/** A set of files. Of two with the same path, the first stays. */
class Folder {
  files = new Map(); // path -> {size, read()}
  leftOut = []; // {path, why}
  #folders = new Set();

  add(path, source) {
    const why = source.problem || pathProblem(path) || this.#conflict(path);
    if (why) this.leftOut.push({ path, why, mayHideAssets: isAsset(path) });
    else this.#keep(path, source);
  }

  /** An archive as a whole. */
  leaveOut(path, why) {
    this.leftOut.push({ path, why, isArchive: true, mayHideAssets: true });
  }

  #conflict(path) {
    if (this.files.size >= MOST_FILES) return `there are more than ${MOST_FILES} files`;
    if (this.files.has(path) || this.#folders.has(path)) return "another file has its path";
    return this.#parents(path).some((one) => this.files.has(one)) ? "a file has the name of its folder" : "";
  }

  #parents(path) {
    const names = path.split("/");
    return names.slice(1).map((_, i) => names.slice(0, i + 1).join("/"));
  }

  #keep(path, source) {
    this.files.set(path, source);
    for (const one of this.#parents(path)) this.#folders.add(one);
  }
}

async function addZip(folder, path, file) {
  try {
    const prefix = path.replace(/\.zip$/i, "") || "zip";
    for (const entry of await readZip(file)) {
      if (!entry.path.startsWith("__MACOSX/")) folder.add(`${prefix}/${entry.path}`, entry);
    }
  } catch (error) {
    folder.leaveOut(path, error.message);
  }
}

/** Opens dropped items, [{path, file}] or [{path, why}]. A .zip counts as a folder of its name. */
export async function openFolder(dropped) {
  const folder = new Folder();
  for (const { path, file, why } of dropped) {
    if (why) folder.leftOut.push({ path, why, mayHideAssets: true });
    else if (isZip(path)) await addZip(folder, path, file);
    else if (isOtherArchive(path)) folder.leaveOut(path, "it is no .zip archive; unpack it first");
    else folder.add(path, { size: file.size, read: async () => new Uint8Array(await file.arrayBuffer()) });
  }
  folder.assets = [...folder.files.keys()].filter(isAsset).sort();
  return folder;
}

/** The JSON text of an asset; of a GLB, its first chunk. */
function jsonText(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const isGlb = bytes.length >= 20 && view.getUint32(0, true) === GLB_MAGIC;
  return new TextDecoder().decode(isGlb ? bytes.subarray(20, 20 + view.getUint32(12, true)) : bytes);
}

/** Each string of a JSON text, also of a broken one, except those too long for a path. */
function* stringsOf(text) {
  for (let begin = text.indexOf('"'); begin >= 0; begin = text.indexOf('"', begin)) {
    let end = text.indexOf('"', begin + 1);
    for (; end >= 0; end = text.indexOf('"', end + 1)) {
      let escapes = 0;
      while (text[end - 1 - escapes] === "\\") ++escapes;
      if (escapes % 2 === 0) break;
    }
    if (end < 0) return;
    if (end - begin < LONGEST_PATH) yield text.slice(begin, end + 1);
    begin = end + 1;
  }
}

function decoded(literal) {
  try {
    const text = JSON.parse(literal);
    return [text, decodeURIComponent(text)];
  } catch {
    return [literal.slice(1, -1)];
  }
}

function joined(folder, relative) {
  const names = folder ? folder.split("/") : [];
  for (const name of relative.split("/")) {
    if (name === "..") names.pop();
    else if (name !== "." && name !== "") names.push(name);
  }
  return names.join("/");
}

/** Paths of the files that some string of the asset's JSON names: its resources are among them. */
function named(files, path, bytes) {
  const folder = path.slice(0, Math.max(0, path.lastIndexOf("/")));
  const found = new Set();
  for (const literal of stringsOf(jsonText(bytes))) {
    for (const text of decoded(literal)) {
      const one = joined(folder, text);
      if (one !== path && files.has(one)) found.add(one);
    }
  }
  return found;
}

/**
 * Assets in groups: those of a group name a common file or one another, those of different groups do not. Groups and
 * their assets keep the order given.
 */
export async function groupsOf(files, paths) {
  const above = new Map(); // from a file to another one of its group; one file of each has none
  const topOf = (path) => {
    let top = path;
    for (let next = above.get(top); next !== undefined; next = above.get(top)) {
      if (above.has(next)) above.set(top, above.get(next)); // makes the next way shorter
      top = next;
    }
    return top;
  };
  for (const path of paths) {
    for (const one of named(files, path, await files.get(path).read())) {
      if (topOf(one) !== topOf(path)) above.set(topOf(one), topOf(path));
    }
  }
  const groups = new Map();
  for (const path of paths) {
    const top = topOf(path);
    if (groups.has(top)) groups.get(top).push(path);
    else groups.set(top, [path]);
  }
  return [...groups.values()];
}

/** Reads files for one run of the engine, and keeps count of their bytes. */
export class Reading {
  content = new Map();
  #files;
  #bytes = 0;

  constructor(files) {
    this.#files = files;
  }

  async add(path) {
    if (this.content.has(path)) return this.content.get(path);
    const source = this.#files.get(path);
    this.#bytes += source.size;
    if (this.#bytes > MOST_BYTES)
      throw new Error("the files are more than 1 GB together; use the program gltfx");
    const bytes = await source.read();
    this.content.set(path, bytes);
    return bytes;
  }

  /** An asset with the files that it names. */
  async addAsset(path) {
    const bytes = await this.add(path);
    for (const one of named(this.#files, path, bytes)) {
      try {
        await this.add(one);
      } catch (error) {
        throw new Error(`${one}: ${error.message}`);
      }
    }
  }
}

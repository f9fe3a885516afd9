// SPDX-License-Identifier: Apache-2.0
// The files that a command line may read: those it names, what they refer to, configuration around them.
// Keys are absolute paths with "/", also on Windows; a key that ends in "/" is a folder.
import { readdirSync, readFileSync, realpathSync, statSync } from "node:fs";
import nodePath from "node:path";
import { referencesIn } from "./references.mjs";

const isAsset = (name) => /\.(gltf|glb)$/i.test(name);
const isRead = (name) => isAsset(name) || /(\.schema\.json|\.bak|^gltfx\.toml|^\.gitignore)$/i.test(name);

/** C:\a\b is /C:/a/b. */
export function virtualPath(path, { sep } = nodePath) {
  if (sep === "/") return path;
  const text = path.replaceAll("\\", "/");
  return /^[A-Za-z]:/.test(text) ? `/${text}` : text;
}

/** The file that the engine means. */
export function realPath(path, cwd, { resolve, sep } = nodePath) {
  return resolve(cwd, sep === "\\" ? path.replace(/^\/(?=[A-Za-z]:)/, "") : path);
}

function kindOf(path) {
  try {
    const found = statSync(path);
    return found.isDirectory() ? "folder" : "file"; // pipes are read like files
  } catch {
    return "none";
  }
}

// A word and what stands behind "=" in it, such as the file of --format=json=FILE.
function partsOf(word) {
  const parts = [word];
  for (let at = word.indexOf("="); at >= 0; at = word.indexOf("=", at + 1)) parts.push(word.slice(at + 1));
  return parts.filter((part) => part !== "" && part !== "-");
}

/** A word of the command line as the engine gets it: paths of Windows get its form of paths. */
export function virtualWord(word, cwd, path = nodePath, exists = (name) => kindOf(name) !== "none") {
  if (path.sep === "/") return word;
  const named = partsOf(word).find((part) => exists(path.resolve(cwd, part)) || /^[A-Za-z]:[\\/]/.test(part));
  return named === undefined ? word : word.slice(0, word.length - named.length) + virtualPath(named, path);
}

class Collection {
  files = new Map();
  #folders = new Set();

  addFolderItself(path) {
    if (kindOf(path) === "folder") this.files.set(virtualPath(path).replace(/\/*$/, "/"), new Uint8Array());
  }

  addFile(path) {
    const key = virtualPath(path);
    if (this.files.has(key)) return;
    let bytes;
    try {
      bytes = readFileSync(path);
    } catch {
      return; // the engine says that it is not there
    }
    this.files.set(key, bytes);
    this.addConfiguration(nodePath.dirname(path));
    if (/gltfx\.toml$/.test(path)) this.addNamedIn(path, bytes.toString());
    if (!isAsset(path) && bytes[0] !== 0x7b && bytes[0] !== 0x67) return;
    for (const reference of referencesIn(bytes)) this.addReference(nodePath.dirname(path), reference);
  }

  addReference(folder, reference) {
    const path = nodePath.resolve(folder, reference);
    if (kindOf(path) === "file" && !isAsset(path)) this.addFile(path);
  }

  // Schemas and the like, which a configuration names in quotes.
  addNamedIn(path, text) {
    for (const [, name] of text.matchAll(/["']([^"'\n]+)["']/g))
      this.addPath(nodePath.resolve(path, "..", name));
  }

  addTree(folder) {
    let real;
    try {
      real = realpathSync(folder);
      if (this.#folders.has(real)) return;
      this.#folders.add(real);
      this.addFolderItself(folder);
      for (const { name } of readdirSync(folder, { withFileTypes: true })) {
        const path = nodePath.join(folder, name);
        const kind = kindOf(path);
        if (kind === "folder" && name !== ".git") this.addTree(path);
        else if (kind === "file" && isRead(name)) this.addFile(path);
      }
    } catch {
      // a folder that cannot be read has nothing
    }
  }

  // gltfx.toml and .gitignore, from the folder up.
  addConfiguration(folder) {
    for (let at = folder; !this.#folders.has(`configuration of ${at}`); at = nodePath.dirname(at)) {
      this.#folders.add(`configuration of ${at}`);
      for (const name of ["gltfx.toml", ".gitignore"]) {
        if (kindOf(nodePath.join(at, name)) === "file") this.addFile(nodePath.join(at, name));
      }
      if (kindOf(nodePath.join(at, ".git")) === "folder") this.addFolderItself(nodePath.join(at, ".git"));
    }
  }

  addPath(path) {
    const kind = kindOf(path);
    this.addFolderItself(nodePath.dirname(path));
    if (kind === "folder") {
      this.addConfiguration(path);
      this.addTree(path);
    }
    if (kind === "file") this.addFile(path);
  }
}

// The folder in which a glob looks.
function folderOfGlob(pattern) {
  const fixed = pattern.slice(0, pattern.search(/[*?[{]/));
  return fixed.slice(0, fixed.search(/[^/\\]*$/)) || ".";
}

function listedPaths(args, cwd, stdin) {
  const at = args.findIndex((word) => word.startsWith("--files-from"));
  if (at < 0) return [];
  const name = args[at].split("=")[1] ?? args[at + 1] ?? "";
  try {
    const bytes = name === "-" ? stdin : readFileSync(nodePath.resolve(cwd, name));
    return bytes
      .toString()
      .split(/\r?\n|\0/)
      .filter((line) => line !== "");
  } catch {
    return [];
  }
}

export function collectFiles(args, cwd, stdin) {
  const collection = new Collection();
  collection.addConfiguration(cwd);
  const [, ...words] = args; // the first one is the verb
  for (const part of [...words.flatMap(partsOf), ...listedPaths(words, cwd, stdin)]) {
    const path = nodePath.resolve(cwd, part);
    if (kindOf(path) === "none" && /[*?[{]/.test(part))
      collection.addTree(nodePath.resolve(cwd, folderOfGlob(part)));
    else collection.addPath(path);
  }
  if (stdin !== undefined) {
    for (const reference of referencesIn(stdin)) collection.addReference(cwd, reference);
  }
  return collection.files;
}

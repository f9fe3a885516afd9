// SPDX-License-Identifier: Apache-2.0
// Paths of this machine and of the engine: the same, except on Windows, where C:\a\b is /C:/a/b in the engine.
import { existsSync } from "node:fs";
import nodePath from "node:path";

/** The engine's form of a path. */
export function virtualPath(path, { sep } = nodePath) {
  if (sep === "/") return path;
  const text = path.replaceAll("\\", "/");
  return /^[A-Za-z]:/.test(text) ? `/${text}` : text;
}

/** This machine's form of an absolute path of the engine. Null: a path of Windows without a drive. */
export function hostPath(path, { sep } = nodePath) {
  if (sep === "/") return path;
  if (!/^\/[A-Za-z]:(\/|$)/.test(path)) return null;
  return path.slice(1, 3) + (path.slice(3).replaceAll("/", "\\") || "\\");
}

// A word and the part after an "=" in it, such as the file of --format=json=FILE.
function partsOf(word) {
  const parts = [word];
  for (let at = word.indexOf("="); at >= 0; at = word.indexOf("=", at + 1)) parts.push(word.slice(at + 1));
  return parts.filter((part) => part !== "");
}

/** A word of the command line for the engine: paths of Windows are converted to its form. */
export function virtualWord(word, cwd, path = nodePath, exists = existsSync) {
  if (path.sep === "/") return word;
  const named = partsOf(word).find((part) => exists(path.resolve(cwd, part)) || /^[A-Za-z]:[\\/]/.test(part));
  return named === undefined ? word : word.slice(0, word.length - named.length) + virtualPath(named, path);
}

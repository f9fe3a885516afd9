// SPDX-License-Identifier: Apache-2.0
// The engine, from the files of the package; made once.
import { readFileSync } from "node:fs";
import { createEngine } from "./engine.mjs";

let made;

async function make() {
  // Reading it with a promise takes ten times as long.
  const wasm = readFileSync(new URL("./gltfx.wasm", import.meta.url));
  const [compiled, loader] = await Promise.all([WebAssembly.compile(wasm), import("./gltfx-wasm.mjs")]);
  return createEngine(compiled, loader.default);
}

export function getEngine() {
  made ??= make();
  return made;
}

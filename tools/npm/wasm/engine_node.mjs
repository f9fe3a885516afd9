// SPDX-License-Identifier: Apache-2.0
// The engine, from the files of the package; made once.
import { readFile } from "node:fs/promises";
import { createEngine } from "./engine.mjs";

let made;

async function make() {
  const [wasm, loader] = await Promise.all([
    readFile(new URL("./gltfx.wasm", import.meta.url)),
    import("./gltfx-wasm.mjs"),
  ]);
  return createEngine(wasm, loader.default);
}

export function getEngine() {
  made ??= make();
  return made;
}

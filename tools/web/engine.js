// SPDX-License-Identifier: Apache-2.0
// The engine of the page: gltfx in WebAssembly. The loader comes from the folder of the build.
import { createEngine } from "../npm/engine.mjs";
import loader from "gltfx-wasm.mjs";

export function startEngine(wasm) {
  return createEngine(wasm, loader);
}

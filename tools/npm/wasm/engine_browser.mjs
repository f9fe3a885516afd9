// SPDX-License-Identifier: Apache-2.0
// The engine, fetched from beside this module; made once; the fetch is repeated after a network failure.
import { createEngine } from "./engine.mjs";

let made;

async function make() {
  const answer = await fetch(new URL("./gltfx.wasm", import.meta.url));
  if (!answer.ok) throw new Error(`gltfx.wasm: ${answer.status} ${answer.statusText}`);
  const [wasm, loader] = await Promise.all([answer.arrayBuffer(), import("./gltfx-wasm.mjs")]);
  return createEngine(wasm, loader.default);
}

export function getEngine() {
  made ??= make().catch((error) => {
    made = undefined;
    throw error;
  });
  return made;
}

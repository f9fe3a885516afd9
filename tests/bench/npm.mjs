// SPDX-License-Identifier: Apache-2.0
// The speed of gltfx/compat against npm's gltf-validator, in one process: a thousand small assets, and one
// document of 70 MB. Prints ratios: how many times faster gltfx is.
//
//   node tests/bench/npm.mjs       the environment is that of tests/npm (tests/npm/packages.mjs)
import { importFrom, install, peer } from "../npm/packages.mjs";

const ours = await importFrom(install({ native: false }), "gltfx/compat.mjs");
const options = { maxIssues: 100, writeTimestamp: false };

// A triangle with a material; no two are alike.
function smallAsset(number) {
  const floats = new Float32Array([0, 0, 0, 1 + number, 0, 0, 0, 1, 0]);
  const data = Buffer.from(floats.buffer).toString("base64");
  return Buffer.from(
    JSON.stringify({
      asset: { version: "2.0", generator: `bench ${number}` },
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0 }],
      materials: [{ pbrMetallicRoughness: { baseColorFactor: [(number % 10) / 10, 1, 1, 1] } }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 }, material: 0 }] }],
      accessors: [
        {
          bufferView: 0,
          componentType: 5126,
          count: 3,
          type: "VEC3",
          min: [0, 0, 0],
          max: [1 + number, 1, 0],
        },
      ],
      bufferViews: [{ buffer: 0, byteLength: 36, target: 34962 }],
      buffers: [{ byteLength: 36, uri: `data:application/octet-stream;base64,${data}` }],
    }),
  );
}

function largeAsset(bytes) {
  const node = (number) => `{"name":"node ${number}","translation":[${number}.5,0.25,-1],"scale":[1,2,3]}`;
  const nodes = [];
  for (let size = 0; size < bytes; size += nodes.at(-1).length + 1 + 8) nodes.push(node(nodes.length));
  const roots = Array.from(nodes.keys()).join();
  return Buffer.from(`{"asset":{"version":"2.0"},"scenes":[{"nodes":[${roots}]}],"nodes":[${nodes.join()}]}`);
}

async function seconds(validator, assets) {
  const begin = performance.now();
  for (const asset of assets) await validator.validateBytes(asset, options);
  return (performance.now() - begin) / 1000;
}

// The best of several runs, taken in turn.
async function compare(name, assets, runs) {
  const best = [Infinity, Infinity];
  for (let run = 0; run < runs; ++run) {
    for (const [at, validator] of [peer, ours].entries())
      best[at] = Math.min(best[at], await seconds(validator, assets));
  }
  const [theirs, mine] = best;
  console.log(
    `${name}: gltf-validator ${theirs.toFixed(3)} s, gltfx ${mine.toFixed(3)} s, ` +
      `ratio ${(theirs / mine).toFixed(2)}`,
  );
}

const small = Array.from({ length: 1000 }, (_, number) => smallAsset(number));
await compare("1,000 small assets", small, 3);
const large = largeAsset(70e6);
await compare(`1 document of ${(large.length / 1e6).toFixed(0)} MB`, [large], 2);

// SPDX-License-Identifier: Apache-2.0
// loaders.gl: GLTFLoader, whose JSON and data postProcessGLTF turns into objects. Extensions that it only passes on as
// JSON have another name in the renamed asset, so that they are equal to it.
import { createRequire } from 'node:module';
import { address, decoded, header, install, serve, get } from './browser_parts.mjs';
import { corners, described, dump, hash } from './dump.mjs';

export async function open(packages) {
  install();
  // Formats that a browser decodes; version 3 has other names for them.
  const imageFormatsNode = ['image/png', 'image/jpeg', 'image/webp', 'image/avif'];
  const parseImageNode = async bytes => ({ ...(await parseImage(bytes)), data: new Uint8Array(0), components: 4, shape: [0, 0, 4] });
  globalThis.loaders = { imageFormatsNode, parseImageNode };
  Object.assign(globalThis, { _imageFormatsNode: imageFormatsNode, _parseImageNode: parseImageNode });
  const require = createRequire(`${packages}/`);
  const core = require('@loaders.gl/core');
  const { GLTFLoader, postProcessGLTF } = require('@loaders.gl/gltf');
  return { load: (files, main) => load(core, GLTFLoader, postProcessGLTF, files, main) };
}

async function parseImage(arrayBuffer) {
  const bytes = Buffer.from(arrayBuffer);
  const size = header(bytes);
  if (!size) throw new Error('the image cannot be decoded');
  decoded.push(hash(bytes));
  return { width: size[0], height: size[1], digest: hash(bytes) };
}

async function load(core, GLTFLoader, postProcess, files, main) {
  serve(files);
  const options = { worker: false, fetch: get, baseUri: address + main, gltf: { postProcess: false }, image: { type: 'data' }, core: { worker: false, fetch: get } };
  const gltf = await core.load(address + main, GLTFLoader, options);
  const objects = postProcess(gltf, options);
  return described(() => ({ dump: dump({ objects, images: [...decoded].sort() }, skip), facts: facts(objects) }));
}

const left = new Set(['uri', 'extensionsUsed', 'extensionsRequired', 'extensionsRemoved', 'generator', 'baseUri', '_glb', 'buffers', 'bufferViews', 'buffer', 'arrayBuffer', 'asset', '_pixel', 'byteOffset', 'byteLength', 'bytesPerElement', 'components', 'extras_']);
const skip = key => left.has(key);

const scales = { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535, 5125: 1, 5126: 1 };
const widths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const values = accessor => {
  const list = accessor.value ?? accessor;
  const scale = accessor.normalized ? scales[accessor.componentType] : 1;
  const width = accessor.size ?? widths[accessor.type] ?? 3;
  return i => Array.from(list.slice(i * width, (i + 1) * width), v => v / scale);
};

function facts(gltf) {
  const parts = [];
  const found = { names: [], morphs: [], images: [...decoded].sort() };
  const visit = (node, place) => {
    found.names.push(node.name);
    const own = v => place(transform(node, v));
    for (const { attributes, indices, mode = 4, targets } of node.mesh?.primitives ?? []) {
      found.morphs.push(targets?.length ?? 0);
      if (!attributes.POSITION) continue;
      const kept = Object.fromEntries(Object.entries(attributes).filter(([name]) => /^(POSITION|NORMAL|TANGENT|COLOR_0|TEXCOORD_[01])$/.test(name)).map(([name, it]) => [name, name === 'COLOR_0' ? i => [...values(it)(i), 1].slice(0, 4) : values(it)]));
      parts.push({ mode, index: indices && Array.from(indices.value), count: attributes.POSITION.count ?? attributes.POSITION.value.length / 3, attributes: kept, place: own });
    }
    for (const child of node.children ?? []) visit(child, own);
  };
  for (const node of gltf.scene?.nodes ?? []) visit(node, v => v);
  found.nodes = found.names;
  found.animations = (gltf.animations ?? []).map(it => it.name);
  found.lights = (gltf.nodes ?? []).filter(it => it.light !== undefined).length;
  found.tracks = (gltf.animations ?? []).flatMap(({ channels, samplers }) => channels.map(channel => {
    const sampler = samplers[channel.sampler];
    const list = index => { const it = gltf.accessors[index]; return Array.from({ length: it.count }, (_, i) => values(it)(i).map(v => v.toFixed(2))); };
    return `${channel.target.path} ${sampler.interpolation ?? 'LINEAR'} ${list(sampler.input)} ${list(sampler.output)}`;
  }));
  found.moved = (gltf.animations ?? []).flatMap(({ channels }) => channels.map(channel => channel.target.node));
  return { ...corners(parts), ...found };
}

function transform({ matrix: m, translation: t = [0, 0, 0], rotation: [x, y, z, w] = [0, 0, 0, 1], scale: s = [1, 1, 1] }, v) {
  if (m) return [0, 1, 2].map(r => m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2] + m[12 + r]);
  const [a, b, c] = v.map((value, i) => value * s[i]);
  const [p, q, r] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * p + y * r - z * q + t[0], b + w * q + z * p - x * r + t[1], c + w * r + x * q - y * p + t[2]];
}

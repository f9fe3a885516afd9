// SPDX-License-Identifier: Apache-2.0
// glTF Transform: NodeIO with all extensions reads an asset into a document, whose properties are compared.
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname } from 'node:path';
import { install } from './browser_parts.mjs';
import { corners, described, dump, hash } from './dump.mjs';

export async function open(packages, tools) {
  install();
  const require = createRequire(`${packages}/`);
  const core = await import(require.resolve('@gltf-transform/core'));
  const { ALL_EXTENSIONS, ...extensions } = await import(require.resolve('@gltf-transform/extensions'));
  const need = createRequire(`${tools}/`);
  const { MeshoptDecoder } = need('meshoptimizer');
  await MeshoptDecoder.ready;
  const io = new core.NodeIO().setLogger(new core.Logger(core.Logger.Verbosity.SILENT))
    .registerExtensions(ALL_EXTENSIONS ?? Object.values(extensions))
    .registerDependencies({ 'draco3d.decoder': await need('draco3dgltf').createDecoderModule({}), 'meshopt.decoder': MeshoptDecoder });
  return { load: (files, main) => load(core, io, files, main) };
}

async function load(core, io, files, main) {
  const folder = mkdtempSync(`${tmpdir()}/gltfx-target-`);
  try {
    for (const [name, bytes] of files) {
      mkdirSync(dirname(`${folder}/${name}`), { recursive: true });
      writeFileSync(`${folder}/${name}`, bytes);
    }
    const document = await io.read(`${folder}/${main}`);
    return described(() => ({ dump: dump(describe(document)), facts: facts(document.getRoot()) }));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

// Every property of the document with its attributes and references, in the order of the root.
function describe(document) {
  const seen = new Map();
  const out = [];
  const visit = property => {
    if (seen.has(property)) return seen.get(property);
    const index = seen.size;
    seen.set(property, index);
    const entry = { kind: property.propertyType, values: {} };
    out[index] = entry;
    for (const key of methods(property)) {
      let value;
      try { value = property[key](); } catch { continue; }
      entry.values[key] = say(value);
    }
    entry.extensions = property.listExtensions?.().map(visit);
    if (property.listSemantics) entry.attributes = property.listSemantics().map(name => [name, say(property.getAttribute(name))]);
    if (property.listTargets) entry.targets = property.listTargets().map(visit);
    return index;
  };
  const isProperty = value => value && typeof value === 'object' && 'propertyType' in value;
  const say = value => (Array.isArray(value) ? value.map(say) : isProperty(value) ? `#${visit(value)}` : value);
  visit(document.getRoot());
  return out;
}
const leftOut = new Set(['getGraph', 'getLogger', 'getDefaults', 'getBuffer', 'getURI', 'getAsset', 'listParents', 'listParentScenes', 'listExtensionsUsed', 'listExtensionsRequired', 'getParentNode', 'getParent', 'getByteLength', 'getVersion']);
function methods(property) {
  const names = new Set();
  for (let it = property; it && it !== Object.prototype; it = Object.getPrototypeOf(it))
    for (const key of Object.getOwnPropertyNames(it))
      if (/^(get|list)[A-Z]/.test(key) && !leftOut.has(key) && typeof property[key] === 'function' && property[key].length === 0) names.add(key);
  return [...names].sort();
}

function facts(root) {
  const parts = [];
  const found = { names: root.listNodes().map(it => it.getName()), morphs: [], images: root.listTextures().map(it => it.getImage() && hash(it.getImage())).sort() };
  found.animations = root.listAnimations().map(it => it.getName());
  found.lights = root.listNodes().filter(it => it.getExtension('KHR_lights_punctual')).length;
  const scene = root.getDefaultScene() ?? root.listScenes()[0];
  scene?.traverse(node => {
    const m = node.getWorldMatrix();
    for (const it of node.getMesh()?.listPrimitives() ?? []) {
      found.morphs.push(it.listTargets().length);
      const position = it.getAttribute('POSITION');
      if (!position) continue;
      const attributes = Object.fromEntries(it.listSemantics().filter(name => /^(POSITION|NORMAL|TANGENT|COLOR_0|TEXCOORD_[01])$/.test(name)).map(name => [name, i => (name === 'COLOR_0' ? [...it.getAttribute(name).getElement(i, []), 1].slice(0, 4) : it.getAttribute(name).getElement(i, []))]));
      parts.push({ mode: it.getMode(), index: it.getIndices() && Array.from(it.getIndices().getArray()), count: position.getCount(), attributes, place: v => [0, 1, 2].map(r => m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2] + m[12 + r]) });
    }
  });
  found.nodes = root.listNodes().map(it => `${it.getName()} ${Array.from(it.getWorldMatrix(), v => v.toFixed(3)).join(' ')}`);
  const list = it => Array.from({ length: it.getCount() }, (_, i) => it.getElement(i, []).map(v => v.toFixed(2)));
  found.tracks = root.listAnimations().flatMap(it => it.listChannels().map(channel => `${channel.getTargetPath()} ${channel.getSampler().getInterpolation()} ${list(channel.getSampler().getInput())} ${list(channel.getSampler().getOutput())}`));
  found.moved = root.listAnimations().flatMap(it => it.listChannels().map(channel => root.listNodes().indexOf(channel.getTargetNode())));
  return { ...corners(parts), ...found };
}

// SPDX-License-Identifier: Apache-2.0
// Babylon.js: the glTF 2.0 loader over NullEngine, which keeps no pixels.
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { address, install, serve } from './browser_parts.mjs';
import { corners, described, dump, hash } from './dump.mjs';

export async function open(packages, tools) {
  install();
  const module = path => import(pathToFileURL(`${packages}/node_modules/@babylonjs/${path}`));
  const B = await module('core/index.js');
  await module('loaders/glTF/index.js');
  B.Logger.LogLevels = 0;
  await registerDecoders(B, tools);
  return { load: (files, main) => load(B, files, main) };
}

async function registerDecoders(B, tools) {
  const require = createRequire(`${tools}/`);
  const { MeshoptDecoder } = require('meshoptimizer');
  await MeshoptDecoder.ready;
  const meshopt = { decodeGltfBufferAsync: async (source, count, stride, mode, filter) => {
    const out = new Uint8Array(count * stride);
    MeshoptDecoder.decodeGltfBuffer(out, count, stride, source, mode, filter);
    return out;
  } };
  B.MeshoptCompression._Default = meshopt;
  // Older versions do not accept a module and request one from a server, which is not measured.
  const decoder = { numWorkers: 0, jsModule: require('draco3dgltf').createDecoderModule };
  for (const name of ['DracoDecoder', 'DracoCompression'])
    if (B[name]) B[name]._Default = new B[name](decoder);
}

async function load(B, files, main) {
  serve(files);
  const engine = new B.NullEngine();
  const images = [];
  const create = engine.createTexture;
  engine.createTexture = function (...args) {
    const bytes = args.find(it => it instanceof Blob || it instanceof ArrayBuffer || ArrayBuffer.isView(it));
    if (bytes) images.push(bytes instanceof Blob ? bytes.arrayBuffer() : bytes);
    return create.apply(this, args);
  };
  const scene = new B.Scene(engine);
  try {
    const container = await B.SceneLoader.LoadAssetContainerAsync(address, main, scene);
    const digests = (await Promise.all(images)).map(bytes => hash(ArrayBuffer.isView(bytes) ? Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength) : Buffer.from(bytes)));
    container.addAllToScene();
    const roots = Object.fromEntries(kinds.map(kind => [kind, container[kind]]));
    // Animations move their targets; the objects are compared in the state of the file.
    for (const group of container.animationGroups) { group.stop(); group.reset(); }
    for (const node of [...container.transformNodes, ...container.meshes]) node.computeWorldMatrix(true);
    const graphs = B.FlowGraphCoordinator?.SceneCoordinators?.get(scene)?.map(it => it._flowGraphs);
    // Members of meshes that drawing does not change.
    const pointers = container.meshes.map(it => [it.isVisible, it.isPickable, it.pointerOverDisableMeshTesting]);
    return described(() => ({ dump: dump({ roots, digests, graphs, pointers }, skip), facts: facts(B, container, digests) }));
  } finally {
    scene.dispose();
    engine.dispose();
  }
}

const kinds = ['meshes', 'materials', 'textures', 'skeletons', 'animationGroups', 'lights', 'cameras', 'transformNodes', 'morphTargetManagers', 'geometries'];
const left = new Set(['_scene', '_engine', '_parentContainer', '_uid', '_hash', '_sceneRootNodesIndex', '_lastFrameTime', '_localDelayOffset', '_currentRenderId', '_creationTime', '_boundingInfo',
  '_rebuildObservers', '_cache', '_renderId', '_childUpdateId', '_currentFrame', '_isDirty', '_worldMatrixDeterminantIsDirty', '_uniformBuffer', '_ub', 'uniqueKey', 'updateFlag', '_childUpdateId', '_url', 'url', '_texture',
  '_absolutePosition', '_effectWrapper', '_materialContext', 'loadingPromise', '_waitingData', '_parsing', 'glTFLoader', '_drawWrapper', '_internalAbstractMeshDataInfo', '_identityMatrix', '_materialDefines', '_eventInfo', 'meshMap']);
const skip = (key, value) => left.has(key) || /unique_?id|renderid|observ|callback|promise|environmentBRDF/i.test(key) || ['Observable', 'NullEngine', 'Scene', 'Promise', 'UniformBuffer', 'Observer', 'SmartArray', 'SmartArrayNoDuplicate'].includes(value?.constructor?.name);

const names = { position: 'POSITION', normal: 'NORMAL', uv: 'TEXCOORD_0', uv2: 'TEXCOORD_1', color: 'COLOR_0', tangent: 'TANGENT' };

function facts(B, container, images) {
  const parts = [];
  const found = { names: [], morphs: [], nodes: [], skin: [] };
  for (const node of [...container.transformNodes, ...container.meshes]) {
    found.names.push(node.name);
    if (node.name !== '__root__') found.nodes.push(`${node.name} ${Array.from(node.getWorldMatrix().m, v => v.toFixed(3)).join(' ')}`);
  }
  for (const mesh of container.meshes) {
    const kinds = (mesh.getVerticesDataKinds?.() ?? []).filter(kind => names[kind] && mesh.getVerticesData(kind));
    if (!kinds.includes('position')) continue;
    found.morphs.push(mesh.morphTargetManager?.numTargets ?? 0);
    const data = Object.fromEntries(kinds.map(kind => [kind, mesh.getVerticesData(kind)]));
    const count = mesh.getTotalVertices();
    const mode = [4, undefined, 0, 0, 1, 2, 3, 5, 6][mesh.material?.fillMode ?? 0] ?? 4;
    const index = mesh.getIndices();
    const world = mesh.getWorldMatrix();
    const visible = !mesh.isUnIndexed && index?.length ? Array.from(index) : null;
    parts.push({
      mode, index: visible, count,
      attributes: Object.fromEntries(kinds.map(kind => [names[kind], i => {
        const width = data[kind].length / count;
        const values = Array.from(data[kind].slice(i * width, (i + 1) * width));
        return kind === 'color' ? [...values, 1].slice(0, 4) : values;
      }])),
      place: v => B.Vector3.TransformCoordinates(B.Vector3.FromArray(v), world).asArray(),
    });
    if (mesh.skeleton) {
      mesh.skeleton.prepare(true);
      found.skin.push(...Array.from(mesh.getPositionData(true, false) ?? [], v => v.toFixed(2)));
    }
  }
  found.tracks = container.animationGroups.flatMap(group => group.targetedAnimations.map(({ animation }) => {
    const list = value => Array.from(value?.asArray?.() ?? [value], v => Number(v ?? 0).toFixed(2));
    return `${animation.targetProperty} ${animation.getKeys().map(key => [key.frame.toFixed(2), list(key.value), key.interpolation ?? '', key.inTangent ? list(key.inTangent) : ''].join(' ')).join('; ')}`;
  }));
  const nodes = [...container.transformNodes, ...container.meshes];
  found.moved = container.animationGroups.flatMap(group => group.targetedAnimations.map(({ target }) => nodes.indexOf(target)));
  found.animations = container.animationGroups.map(it => it.name);
  found.lights = Math.min(container.lights.length, ...container.materials.map(it => it.maxSimultaneousLights ?? Infinity));
  for (const list of [found.names, found.nodes]) list.sort();
  return { ...corners(parts), ...found, images: images.sort() };
}

// SPDX-License-Identifier: Apache-2.0
// three.js: GLTFLoader, with the decoders of npm, and a KTX2Loader that does not transcode.
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { existsSync } from 'node:fs';
import { address, decoded, install, serve } from './browser_parts.mjs';
import { corners, described, dump, hash } from './dump.mjs';

export const measured = 'objects';

export async function open(packages, tools, { decoders = true } = {}) {
  install();
  const module = path => import(pathToFileURL(`${packages}/node_modules/three/${path}`));
  const THREE = await module('build/three.module.js');
  const examples = existsSync(`${packages}/node_modules/three/examples/jsm/loaders/GLTFLoader.js`) ? 'examples/jsm/' : 'addons/';
  const { GLTFLoader } = await module(`${examples}loaders/GLTFLoader.js`);
  const parts = decoders ? await decoderParts(THREE, tools) : null;
  return { load: (files, main) => load(THREE, GLTFLoader, parts, files, main) };
}

async function decoderParts(THREE, tools) {
  const require = createRequire(`${tools}/`);
  const draco = await require('draco3dgltf').createDecoderModule({});
  const { MeshoptDecoder } = require('meshoptimizer');
  await MeshoptDecoder.ready;
  const dracoLoader = {
    preload() { return this; },
    decodeDracoFile: (bytes, done, ids, types, ...rest) => done(geometryOf(THREE, draco, bytes, ids, types)),
  };
  const ktx2Loader = {
    isKTX2Loader: true,
    load(url, done, progress, failed) {
      fetch(url).then(async answer => {
        if (!answer.ok) throw new Error(`harness: ${url} is not there`);
        const bytes = Buffer.from(await answer.arrayBuffer());
        if (bytes.toString('latin1', 1, 7) !== 'KTX 20') throw new Error('no KTX 2');
        decoded.push(hash(bytes));
        const texture = new THREE.CompressedTexture([], 16, 16);
        texture.userData.digest = hash(bytes);
        done(texture);
      }).catch(failed);
    },
  };
  return { dracoLoader, ktx2Loader, MeshoptDecoder };
}

function geometryOf(THREE, draco, bytes, ids, types) {
  const decoder = new draco.Decoder();
  const mesh = new draco.Mesh();
  decoder.DecodeArrayToMesh(new Int8Array(bytes), bytes.byteLength, mesh);
  const geometry = new THREE.BufferGeometry();
  for (const name of Object.keys(ids)) {
    const attribute = decoder.GetAttributeByUniqueId(mesh, ids[name]);
    const values = new draco.DracoFloat32Array();
    decoder.GetAttributeFloatForAllPoints(mesh, attribute, values);
    geometry.setAttribute(name, new THREE.BufferAttribute(Float32Array.from({ length: values.size() }, (_, i) => values.GetValue(i)), attribute.num_components()));
  }
  const face = new draco.DracoInt32Array();
  const index = [];
  for (let i = 0; i < mesh.num_faces(); ++i) {
    decoder.GetFaceFromMesh(mesh, i, face);
    index.push(face.GetValue(0), face.GetValue(1), face.GetValue(2));
  }
  geometry.setIndex(index);
  return geometry;
}

async function load(THREE, GLTFLoader, parts, files, main) {
  serve(files);
  THREE.Cache?.clear?.();
  const loader = new GLTFLoader();
  if (parts) {
    loader.setDRACOLoader(parts.dracoLoader);
    loader.setKTX2Loader(parts.ktx2Loader);
    loader.setMeshoptDecoder(parts.MeshoptDecoder);
  }
  const gltf = await new Promise((done, failed) => loader.load(address + main, done, undefined, failed));
  const { scene, scenes, animations, cameras } = gltf;
  for (const it of scenes) it.updateMatrixWorld(true);
  return described(() => ({ dump: dump({ scene, scenes, animations, cameras }, skip), facts: facts(THREE, gltf) }));
}

const left = new Set(['uuid', 'id', '_listeners', 'version', '_id', 'matrixWorldNeedsUpdate']);
const skip = (key, value, owner) => left.has(key) || (key === 'data' && owner.isSource === undefined && value instanceof Promise);

const names = { position: 'POSITION', normal: 'NORMAL', uv: 'TEXCOORD_0', uv1: 'TEXCOORD_1', uv2: 'TEXCOORD_1', color: 'COLOR_0', tangent: 'TANGENT', skinIndex: 'JOINTS_0', skinWeight: 'WEIGHTS_0' };
const getters = ['getX', 'getY', 'getZ', 'getW'];

function facts(THREE, { scene, animations }) {
  const parts = [];
  const found = { names: [], morphs: [], skin: [], nodes: [], animations: animations.map(it => it.name), lights: 0 };
  scene?.traverse(object => {
    found.names.push(object.name);
    found.nodes.push(`${object.name} ${object.matrixWorld.elements.map(v => v.toFixed(3)).join(' ')}`);
    if (object.isLight) found.lights += 1;
    if (!object.geometry) return;
    const { attributes, index, morphAttributes } = object.geometry;
    found.morphs.push(morphAttributes.position?.length ?? 0);
    const attribute = it => i => getters.slice(0, it.itemSize).map(get => it[get](i));
    parts.push({
      mode: object.isPoints ? 0 : object.isLineLoop ? 2 : object.isLineSegments ? 1 : object.isLine ? 3 : 4,
      index: index && Array.from(index.array), count: attributes.position?.count ?? 0,
      attributes: Object.fromEntries(Object.entries(attributes).filter(([name]) => names[name]).map(([name, it]) => [names[name], padded(names[name], attribute(it))])),
      place: v => new THREE.Vector3(...v).applyMatrix4(object.matrixWorld).toArray(),
    });
    if (object.isSkinnedMesh) for (let i = 0; i < attributes.position.count; ++i) found.skin.push(skinPlace(THREE, object, i));
  });
  found.tracks = animations.flatMap(it => it.tracks.map(track => `${track.name.split('.').pop()} ${interpolation(track)} ${Array.from(track.times, v => v.toFixed(2))} ${Array.from(track.values, v => v.toFixed(2))}`));
  return { ...corners(parts), ...found, images: [...decoded].sort(), moved: moved(THREE, scene, animations) };
}

// 2300: steps. A spline has a function of GLTFLoader.
const interpolation = track => track.createInterpolant.isInterpolantFactoryMethodGLTFCubicSpline ? 'spline' : track.getInterpolation() === 2300 ? 'step' : 'linear';

// Colors in three or four components are the same where alpha is 1.
const padded = (name, get) => (name === 'COLOR_0' ? i => [...get(i), 1].slice(0, 4) : get);

// The numbers of the objects that animations move. The objects stay moved.
function moved(THREE, scene, animations) {
  const objects = [];
  scene?.traverse(it => objects.push(it));
  const places = () => objects.map(it => `${it.position.toArray()} ${it.quaternion.toArray()} ${it.scale.toArray()}`);
  const before = places();
  const mixer = new THREE.AnimationMixer(scene ?? new THREE.Object3D());
  for (const it of animations) mixer.clipAction(it).play();
  mixer.setTime(0.5);
  return places().flatMap((place, i) => (place === before[i] ? [] : [i]));
}

function skinPlace(THREE, mesh, i) {
  const v = new THREE.Vector3().fromBufferAttribute(mesh.geometry.attributes.position, i);
  mesh.skeleton.update();
  return (mesh.applyBoneTransform ?? mesh.boneTransform).call(mesh, i, v).toArray().map(x => x.toFixed(2)).join(' ');
}

// SPDX-License-Identifier: Apache-2.0
// PlayCanvas: the container handler over a null device, which keeps no pixels.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { address, decoded, install, serve } from './browser_parts.mjs';
import { corners, described, dump } from './dump.mjs';

export async function open(packages) {
  install();
  // The build in one file: a CommonJS module, despite package.json. Some versions name themselves pc.
  const module = { exports: {} };
  globalThis.pc = module.exports;
  const text = readFileSync(`${packages}/node_modules/playcanvas/build/playcanvas.js`, 'utf8');
  new Function('module', 'exports', 'require', text)(module, module.exports, createRequire(import.meta.url));
  const pc = module.exports;
  return { load: (files, main) => load(pc, files, main) };
}

async function load(pc, files, main) {
  serve(files);
  const canvas = document.createElement('canvas');
  const device = new pc.NullGraphicsDevice(canvas, {});
  const options = Object.assign(new pc.AppOptions(), { graphicsDevice: device, resourceHandlers: [pc.ContainerHandler, pc.TextureHandler, pc.AnimationHandler].filter(Boolean), componentSystems: [pc.RenderComponentSystem, pc.LightComponentSystem, pc.CameraComponentSystem, pc.AnimComponentSystem, pc.ModelComponentSystem].filter(Boolean) });
  const app = new pc.AppBase(canvas);
  app.init(options);
  try {
    const asset = await new Promise((done, failed) => {
      const it = new pc.Asset(main, 'container', { url: address + main, filename: main });
      it.on('load', () => done(it));
      it.on('error', failed);
      app.assets.add(it);
      app.assets.load(it);
    });
    const entity = asset.resource.instantiateRenderEntity();
    app.root.addChild(entity);
    const parts = asset.resource;
    const built = list => (list ?? []).map(it => it?.resource ?? it);
    const roots = { renders: built(parts.renders).map(it => it.meshes), materials: built(parts.materials), textures: built(parts.textures), animations: built(parts.animations), variants: Object.keys(parts.data?.variants ?? {}) };
    return described(() => ({ dump: dump({ roots, entities: entities(entity), images: [...decoded].sort() }, skip).replace(counted, '$1"'), facts: facts(pc, entity, parts) }));
  } finally {
    app.destroy();
  }
}

// Names of textures end in a number that counts all textures so far.
const counted = /^(.* _addressU=.* name="[^"\n]*)-\d+"/gm;

const left = new Set(['id', '_id', '_app', '_device', 'device', 'app', '_registry', 'registry', '_system', 'system', '_callbacks', '_callbackActive', 'graphicsDevice', '_guid', 'guid', 'key', '_shader', 'variants', 'profilerHint', '_parent', 'impl', '_storage', 'adapter', '_gpuSize', '_loader', 'loader', '_file', 'file', '_url', 'url', 'renderVersion', 'renderVersionDirty', 'meshInstances', '_resources', '_resource', 'nodes', '_allocated', 'stamp', '_textures', '_hash', 'hash', '_shaderVersion', 'name_', 'sortKeyShadow', 'refCount', '_refCount', 'dirtyBlend_', 'renderFrame']);
const skip = (key, value, owner) => (left.has(key) && !(key === 'variants' && owner.renders)) || /version$|uniqueid/i.test(key) || ['Asset', 'NullGraphicsDevice', 'AppBase', 'Events', 'EventHandle'].includes(value?.constructor?.name);

// The data of the entities, without internal members.
function entities(root) {
  const out = [];
  root.forEach(node => {
    const it = { name: node.name, enabled: node._enabled, world: Array.from(node.getWorldTransform().data) };
    if (node.render) it.render = node.render.meshInstances.map(mesh => ({ material: mesh.material.name, instances: mesh.instancingCount ?? mesh.instancingData?.count, visible: mesh.visible }));
    if (node.light) it.light = ['type', 'color', 'intensity', 'range', 'innerConeAngle', 'outerConeAngle'].map(key => `${node.light[key]}`);
    if (node.camera) it.camera = ['projection', 'fov', 'nearClip', 'farClip', 'orthoHeight', 'aspectRatio'].map(key => `${node.camera[key]}`);
    out.push(it);
  });
  return out;
}

const semantics = { POSITION: 'POSITION', NORMAL: 'NORMAL', TANGENT: 'TANGENT', COLOR: 'COLOR_0', TEXCOORD0: 'TEXCOORD_0', TEXCOORD1: 'TEXCOORD_1' };

function facts(pc, root, parts) {
  const list = [];
  const found = { names: [], morphs: [], nodes: [], skin: [], lights: 0, images: [...decoded].sort() };
  const readable = new Map();
  root.forEach(node => {
    found.names.push(node.name);
    found.nodes.push(`${node.name} ${Array.from(node.getWorldTransform().data, v => v.toFixed(3)).join(' ')}`);
    if (node.light) found.lights += 1;
    for (const instance of node.render?.meshInstances ?? []) {
      const mesh = instance.mesh;
      found.morphs.push(mesh.morph?.targets.length ?? 0);
      if (instance.skinInstance) found.skin.push(...skinned(pc, instance));
      const primitive = mesh.primitive[0];
      const attributes = {};
      for (const element of mesh.vertexBuffer.format.elements) {
        const name = semantics[element.name];
        if (!name) continue;
        const view = elementReader(mesh.vertexBuffer, element);
        attributes[name] = name === 'COLOR_0' ? i => [...view(i), 1].slice(0, 4) : view;
      }
      const indices = mesh.indexBuffer?.[0];
      const index = indices ? Array.from(new [Uint8Array, Uint16Array, Uint32Array][indices.format](indices.storage ?? indices.lock())) : null;
      const world = node.getWorldTransform();
      list.push({
        mode: [0, 1, 2, 3, 4, 5, 6][primitive.type], index: primitive.indexed ? index.slice(primitive.base, primitive.base + primitive.count) : null, count: primitive.count,
        attributes, place: v => { const out = world.transformPoint(new pc.Vec3(v[0], v[1], v[2])); return [out.x, out.y, out.z]; },
      });
    }
  });
  found.tracks = (parts.animations ?? []).flatMap(asset => {
    const track = asset.resource;
    const text = values => Array.from(values, v => Number(v).toFixed(2));
    return track.curves.map(curve => `${curve.paths.map(path => path.propertyPath ?? path).join()} ${curve.interpolation} ${text(track.inputs[curve.input]._data ?? track.inputs[curve.input].data)} ${text(track.outputs[curve.output]._data ?? track.outputs[curve.output].data)}`);
  });
  found.animations = (parts.animations ?? []).map(asset => asset.resource.name);
  found.moved = moved(pc, root, parts.animations ?? []);
  return { ...corners(list), ...found };
}

// The numbers of the entities that animations move. The entities stay moved.
function moved(pc, root, animations) {
  const all = [];
  root.forEach(node => all.push(node));
  const places = () => all.map(it => `${it.getLocalPosition()} ${it.getLocalRotation()} ${it.getLocalScale()}`);
  const before = places();
  root.addComponent('anim', { activate: true });
  animations.forEach((asset, i) => root.anim.assignAnimation(`Move${i}`, asset.resource));
  pc.app.systems.fire('animationUpdate', 0.5);
  return places().flatMap((place, i) => (place === before[i] ? [] : [i]));
}

// Where the vertices of a skinned mesh are, by the attributes that its vertex buffer has.
function skinned(pc, instance) {
  const { skin, bones } = instance.skinInstance;
  const matrices = bones.map((bone, i) => new pc.Mat4().mul2(bone.getWorldTransform(), skin.inverseBindPose[i]));
  const buffer = instance.mesh.vertexBuffer;
  const [positions, weights, joints] = ['POSITION', 'BLENDWEIGHT', 'BLENDINDICES'].map(name => elementReader(buffer, buffer.format.elements.find(it => it.name === name)));
  return Array.from({ length: buffer.numVertices }, (_, i) => {
    const sum = new pc.Vec3();
    joints(i).forEach((joint, k) => sum.add(matrices[joint].transformPoint(new pc.Vec3(...positions(i))).mulScalar(weights(i)[k])));
    return [sum.x, sum.y, sum.z].map(v => v.toFixed(2)).join(' ');
  });
}

const arrays = [[1, 'getInt8', 127], [1, 'getUint8', 255], [2, 'getInt16', 32767], [2, 'getUint16', 65535], [4, 'getInt32', 1], [4, 'getUint32', 1], [4, 'getFloat32', 1]];
function elementReader(buffer, element) {
  const bytes = buffer.storage ?? buffer.lock();
  const view = new DataView(bytes.buffer ?? bytes, bytes.byteOffset ?? 0);
  const [size, get, scale] = arrays[element.dataType];
  const unit = element.normalize ? scale : 1;
  return i => Array.from({ length: element.numComponents }, (_, c) => view[get](element.offset + i * element.stride + c * size, true) / unit);
}

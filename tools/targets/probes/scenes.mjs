// SPDX-License-Identifier: Apache-2.0
// Probes of scenes, nodes, cameras, animations, materials, textures and unknown extensions.
import { inlinedTechnique, lights, metadata, technique } from './extensions.mjs';
import { colors, model, place, primitive, sharp, square, texture, textured } from './models.mjs';
import { png, quadrants } from './png.mjs';

const twinned = (make, change, more = {}) => {
  const [asset, twin] = [make(), make()];
  change(asset);
  return { asset, twin, ...more };
};
const material = asset => asset.json.materials[0];
const node = asset => asset.json.nodes[0];
const scenes = asset => asset.json.scenes;

const two = () => {
  const asset = model();
  place(asset, [primitive(asset, square(0.5, 2))]);
  return asset;
};

// One animation of a node.
function animated(path, values, { times = [0, 1], type = 'VEC3', componentType = 5126, interpolation, normalized, of = model(), target } = {}) {
  const input = of.accessor(times, { type: 'SCALAR', bounds: true });
  const output = of.accessor(values, { type, componentType, normalized });
  of.add('animations', { name: `Move${of.json.animations?.length ?? 0}`, samplers: [{ input, output, ...(interpolation && { interpolation }) }], channels: [{ sampler: 0, target: target ?? { node: 0, path } }] });
  return of;
}
const slide = [0, 0, 0, 1, 0, 0];
const half = Math.SQRT1_2;
const turn = [0, 0, 0, 1, 0, 0, half, half];
const still = (path, values, options) => ({ asset: animated(path, values, options), twin: model() });
const turned = (componentType, scale) => ({
  asset: animated('rotation', turn.map(v => Math.round(v * scale)), { type: 'VEC4', componentType, normalized: true }),
  twin: animated('rotation', turn.map(v => Math.round(v * scale) / scale), { type: 'VEC4' }),
  same: ['tracks'],
});

function morphing() {
  const asset = model({ shape: square() });
  const target = { POSITION: asset.attribute([0, 0, 0, 0, 0, 0, 0.5, 0.2, 0.7, 0, 0, 0], { bounds: true }) };
  asset.json.meshes[0].primitives[0].targets = [target];
  asset.json.meshes[0].weights = [0];
  return asset;
}

function camera(content, extra = {}) {
  return twinned(() => model(), asset => {
    const index = asset.add('cameras', { name: 'View', ...content });
    scenes(asset)[0].nodes.push(asset.add('nodes', { name: 'View', camera: index, translation: [0, 0, 4] }));
  }, extra);
}
const perspective = (more = {}) => ({ type: 'perspective', perspective: { yfov: 0.7, znear: 0.1, aspectRatio: 1.5, ...more } });

const wraps = (wrap, of = {}) => twinned(() => wrapped(10497, of), asset => { Object.assign(asset.json.samplers[0], wrap); });
function wrapped(wrap, sampler, image) {
  const shape = square();
  shape.TEXCOORD_0 = shape.TEXCOORD_0.map(v => v * 3 - 1);
  return textured({ image, sampler: { wrapS: wrap, wrapT: wrap, magFilter: 9729, minFilter: 9987, ...sampler } }, { shape });
}

// A model with a texture in a slot; set() puts the slot into the material.
const slot = (set, of = {}) => twinned(() => model({ shape: square(), only: ['POSITION', 'NORMAL', 'TANGENT', 'TEXCOORD_0'], ...of }), asset => set(material(asset), texture(asset)));
const normalMap = png({ size: [16, 16], at: (x, y) => (x < 8 ? [200, 128, 215, 255] : [80, 160, 225, 255]) });
const slotOf = (name, members, changed) => twinned(() => {
  const asset = model({ shape: square(), only: ['POSITION', 'NORMAL', 'TANGENT', 'TEXCOORD_0'] });
  material(asset)[name] = { index: texture(asset, { image: normalMap, uri: 'map.png' }), ...members };
  return asset;
}, asset => Object.assign(material(asset)[name], changed));

// A texture that another set of texture coordinates moves.
function coordinates(set, count) {
  return twinned(() => {
    const asset = textured();
    const uv = [0.2, 0.9, 0.7, 0.9, 0.7, 0.1, 0.2, 0.1];
    for (let i = 1; i <= count; ++i) asset.json.meshes[0].primitives[0].attributes[`TEXCOORD_${i}`] = asset.attribute(uv.map(v => v / i), { type: 'VEC2' });
    return asset;
  }, asset => set(material(asset).pbrMetallicRoughness.baseColorTexture));
}
const transformed = (content, other) => twinned(() => {
  const asset = coordinates(() => {}, 1).asset;
  const info = material(asset).pbrMetallicRoughness.baseColorTexture;
  info.extensions = { KHR_texture_transform: { offset: [0.1, 0.2] } };
  asset.uses('KHR_texture_transform');
  if (other) material(asset).emissiveFactor = [1, 1, 1];
  if (other) material(asset).emissiveTexture = { index: info.index, extensions: { KHR_texture_transform: { offset: [0.1, 0.2] } } };
  return asset;
}, asset => Object.assign((other ? material(asset).emissiveTexture : material(asset).pbrMetallicRoughness.baseColorTexture).extensions.KHR_texture_transform, content));

const cutOut = alphaMode => textured({ image: png({ size: [16, 16], at: quadrants([16, 16], [255, 140, 60, 0]), kind: 'rgba' }) },
  { material: alphaMode && { alphaMode } });
const unknown = required => twinned(() => model(), asset => {
  asset.uses('GLTFX_probe', required);
  material(asset).extensions = { GLTFX_probe: { amount: 0.5 } };
}, { differs: ['corners'] });

export const scene = {
  'scene.none': () => twinned(() => two(), asset => { delete asset.json.scenes; delete asset.json.scene; }, { same: ['corners'] }),
  'scene.no-default': () => twinned(() => two(), asset => { delete asset.json.scene; }, { same: ['corners'] }),
  'scene.several': () => twinned(() => two(), asset => { asset.json.scenes = [{ name: 'Scene', nodes: [0] }, { name: 'Other', nodes: [1] }]; }),
  'scene.default-not-first': () => ({ asset: chosen(1), twin: chosen(0) }),
  'scene.empty': () => twinned(() => two(), asset => { delete scenes(asset)[0].nodes; }),
  'node.matrix': () => ({ asset: model({ node: { matrix: [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 1, 2, 0, 1] } }), twin: model() }),
  'node.negative-scale': () => ({ asset: model({ node: { scale: [-1, 1, 1] } }), twin: model() }),
  'node.zero-scale': () => ({ asset: model({ node: { scale: [0, 1, 1] } }), twin: model() }),
  'node.mesh-shared': () => twinned(() => two(), asset => { scenes(asset)[0].nodes.push(asset.add('nodes', { name: 'Again', mesh: 0, translation: [2, 0, 0] })); }),
  'node.name-doubled': () => twinned(() => animated('translation', slide, { of: two(), target: { node: 1, path: 'translation' } }), asset => { asset.json.nodes[1].name = 'Node0'; }, { same: ['moved'] }),
  'node.name-special': () => ({ asset: model({ node: { name: 'arm.[left]:/a' } }), twin: model({ node: { name: 'arm' } }), names: ['arm.[left]:/a'] }),
  extras: () => twinned(() => model(), asset => { node(asset).extras = { weight: 12, tags: ['a'] }; }),
  'node.translation-over-million': () => ({ asset: below(16e6, -16e6 + 0.5), twin: below(0, 0.5), same: ['corners'] }),
  'camera.perspective': () => camera(perspective({ zfar: 50 })),
  'camera.orthographic': () => camera({ type: 'orthographic', orthographic: { xmag: 2, ymag: 1.5, znear: 0.1, zfar: 50 } }),
  'camera.infinite': () => camera(perspective()),
  'animation.translation': () => still('translation', slide),
  'animation.rotation': () => still('rotation', turn, { type: 'VEC4' }),
  'animation.scale': () => still('scale', [1, 1, 1, 2, 1, 1]),
  'animation.weights': () => ({ asset: animated('weights', [0, 1], { type: 'SCALAR', of: morphing() }), twin: morphing() }),
  'animation.step': () => ({ asset: animated('translation', slide, { interpolation: 'STEP' }), twin: animated('translation', slide, { interpolation: 'LINEAR' }), differs: ['tracks'] }),
  'animation.cubic-spline': () => ({ asset: animated('translation', [0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 3, 0, 1, 0, 0, 0, 0, 0], { interpolation: 'CUBICSPLINE' }), twin: animated('translation', slide), differs: ['tracks'] }),
  'animation.rotation-int8': () => turned(5120, 127),
  'animation.rotation-int16': () => turned(5122, 32767),
  'animation.weights-uint8': () => ({
    asset: animated('weights', [0, 255], { type: 'SCALAR', componentType: 5121, normalized: true, of: morphing() }),
    twin: animated('weights', [0, 1], { type: 'SCALAR', of: morphing() }), same: ['tracks'] }),
  'animation.several': () => ({ asset: animated('scale', [1, 1, 1, 2, 1, 1], { of: animated('translation', slide) }), twin: animated('translation', slide) }),
  'animation.name': () => twinned(() => animated('translation', slide), asset => { asset.json.animations[0].name = 'Walk'; }, { names: ['Walk'], among: 'animations' }),
  'animation.name-doubled': () => twinned(() => animated('scale', [1, 1, 1, 2, 1, 1], { of: animated('translation', slide) }),
    asset => { for (const it of asset.json.animations) it.name = 'Walk'; }, { names: ['Walk', 'Walk'], among: 'animations' }),
  'animation.single-key': () => still('translation', [1, 2, 0], { times: [0] }),
  'animation.late-start': () => ({ asset: animated('translation', slide, { times: [1, 2] }), twin: animated('translation', slide) }),
  'animation.no-target': () => ({ asset: animated('translation', slide, { target: { path: 'translation' } }), twin: model() }),
  'material.alpha-mask': () => twinned(() => cutOut(), asset => { material(asset).alphaMode = 'MASK'; }),
  'material.alpha-cutoff': () => twinned(() => cutOut('MASK'), asset => { material(asset).alphaCutoff = 0.2; }),
  'material.alpha-blend': () => twinned(() => cutOut(), asset => { material(asset).alphaMode = 'BLEND'; }),
  'material.double-sided': () => twinned(() => model({ shape: square(), node: { rotation: [0, 1, 0, 0] } }), asset => { material(asset).doubleSided = true; }),
  'material.emissive': () => twinned(() => model(), asset => { material(asset).emissiveFactor = [0.2, 0.6, 0.9]; }),
  'material.base-color-texture': () => slot((it, index) => { it.pbrMetallicRoughness.baseColorTexture = { index }; }),
  'material.metallic-roughness-texture': () => slot((it, index) => { it.pbrMetallicRoughness.metallicRoughnessTexture = { index }; }, { material: { pbrMetallicRoughness: {} } }),
  'material.normal-texture': () => slot((it, index) => { it.normalTexture = { index }; }),
  'material.normal-scale': () => slotOf('normalTexture', {}, { scale: 0.2 }),
  'material.occlusion-texture': () => slot((it, index) => { it.occlusionTexture = { index }; }),
  'material.occlusion-strength': () => slotOf('occlusionTexture', {}, { strength: 0.2 }),
  'material.emissive-texture': () => slot((it, index) => { it.emissiveTexture = { index }; }, { material: { emissiveFactor: [1, 1, 1] } }),
  'material.blended-sheen-specular': () => twinned(() => clothed(), asset => { material(asset).alphaMode = 'BLEND'; }),
  'texture.no-source': () => twinned(() => model({ shape: square() }), asset => {
    material(asset).pbrMetallicRoughness.baseColorTexture = { index: asset.add('textures', {}) };
  }),
  'texture.texcoord-1': () => coordinates(info => { info.texCoord = 1; }, 1),
  'texture.texcoord-2': () => coordinates(info => { info.texCoord = 2; }, 2),
  'texture.sampler-clamp': () => wraps({ wrapS: 33071, wrapT: 33071 }),
  'texture.sampler-mirrored': () => wraps({ wrapS: 33648, wrapT: 33648 }),
  'texture.sampler-nearest': () => wraps({ magFilter: 9728 }),
  'texture.sampler-no-mipmaps': () => wraps({ minFilter: 9729 }),
  'image.non-power-of-two-repeated': () => ({ asset: wrapped(10497, sharp, colors([48, 40])), twin: wrapped(10497, sharp), same: ['pixels'] }),
  'texture-transform.texcoord': () => transformed({ texCoord: 1 }),
  'texture-transform.rotation': () => transformed({ rotation: 0.6 }),
  'texture-transform.other-slots': () => transformed({ offset: [0.6, 0.7], scale: [3, 2] }, true),
  'light.directional': () => lit('directional'),
  'light.point': () => lit('point'),
  'light.spot': () => lit('spot'),
  ...Object.fromEntries([4, 8, 16].map(n => [`light.lights-over-${n}`, () => lamps(n, { type: 'point', intensity: 0.5 }, { type: 'point', intensity: 60 })])),
  // The second one is weaker, for engines with room for the strongest.
  'light.several-directional': () => lamps(1, { type: 'directional', intensity: 4 }, { type: 'directional', intensity: 2 }),
  'techniques.shader-uri': () => required('KHR_techniques_webgl', inlinedTechnique().asset, technique().asset),
  'structural-metadata.boolean': () => column({ type: 'BOOLEAN' }, { values: Uint8Array.of(2) }),
  'structural-metadata.enum': () => column({ type: 'ENUM', enumType: 'kind' }, { values: Uint16Array.of(0, 1) },
    { enums: { kind: { values: [{ name: 'wall', value: 0 }, { name: 'roof', value: 1 }] } } }),
  'structural-metadata.string': () => column({ type: 'STRING' }, { values: Buffer.from('wallroof'), stringOffsets: Uint32Array.of(0, 4, 8) }),
  'structural-metadata.matrix': () => column({ type: 'MAT2', componentType: 'FLOAT32' }, { values: Float32Array.of(1, 0, 0, 1, 2, 0, 0, 2) }),
  'structural-metadata.array': () => column({ type: 'SCALAR', componentType: 'FLOAT32', array: true }, { values: Float32Array.of(1, 2, 3), arrayOffsets: Uint32Array.of(0, 1, 3) }),
  'structural-metadata.array-fixed': () => column({ type: 'SCALAR', componentType: 'FLOAT32', array: true, count: 2 }, { values: Float32Array.of(1, 2, 3, 4) }),
  'extension.unknown-used': () => unknown(false),
  'extension.unknown-required': () => unknown(true),
};

function lit(type) {
  const { asset, twin } = lights[type]();
  asset.uses('KHR_lights_punctual');
  return { asset, twin };
}

const clothed = () => model({ material: { extensions: { KHR_materials_sheen: { sheenColorFactor: [0.9, 0.2, 0.9] }, KHR_materials_specular: { specularFactor: 0.5 } } } })
  .uses('KHR_materials_sheen').uses('KHR_materials_specular');

// So many lights of one kind, and one more, which shows.
function lamps(count, kind, last) {
  const asset = model().uses('KHR_lights_punctual');
  asset.json.extensions = { KHR_lights_punctual: { lights: [{ ...kind, name: 'Lamp' }, { ...last, name: 'Last', color: [1, 0.2, 0.1] }] } };
  const hang = (name, light, place) => scenes(asset)[0].nodes.push(asset.add('nodes', { name, translation: place, rotation: [-0.5, 0, 0, Math.sqrt(0.75)], extensions: { KHR_lights_punctual: { light } } }));
  for (let i = 0; i < count; ++i) hang(`Lamp${i}`, 0, [2 * Math.cos(i), 2, 2 * Math.sin(i)]);
  const twin = asset.copy();
  twin.json.extensions.KHR_lights_punctual.lights.pop();
  hang('Last', 1, [1, 1, 2]);
  return { asset, twin, differs: ['lights'], of: 'KHR_lights_punctual' };
}

// A model below a node, each moved along x.
function below(first, second) {
  const asset = model({ shape: square(), node: { translation: [second, 0, 0] } });
  scenes(asset)[0].nodes = [asset.add('nodes', { name: 'Root', translation: [first, 0, 0], children: [0] })];
  return asset;
}

function chosen(index) {
  const asset = two();
  asset.json.scenes = [{ name: 'One', nodes: [0] }, { name: 'Two', nodes: [1] }];
  asset.json.scene = index;
  return asset;
}

function required(name, asset, twin) {
  for (const it of [asset, twin]) it.uses(name, true);
  return { asset, twin, of: name };
}

// A table whose property is not a number; that of its twin is one.
function column(...property) {
  const [asset, twin] = [metadata(...property).asset, metadata().asset].map(it => it.uses('EXT_structural_metadata'));
  return { asset, twin, of: 'EXT_structural_metadata' };
}

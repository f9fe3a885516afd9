// SPDX-License-Identifier: Apache-2.0
// Probes of accessors, indices, primitives, attributes, morph targets and skins.
import { Asset } from './asset.mjs';
import { kinds, model, place, plain, primitive, sphere, square } from './models.mjs';

const twinned = (make, change, ...same) => {
  const [asset, twin] = [make(), make()];
  change(asset);
  return { asset, twin, ...(same.length && { same }) };
};
const mesh = asset => asset.json.meshes[0];
const first = asset => mesh(asset).primitives[0];

// An asset of one primitive with these attributes beside POSITION: { name: [values, kind] }.
function made(shape, extra = {}, { only = ['POSITION', 'NORMAL', 'TEXCOORD_0'], indices = 5123, mode, material = {} } = {}) {
  const asset = new Asset();
  asset.add('materials', { ...plain(), ...material });
  const it = primitive(asset, shape, { only, indices });
  for (const [name, [values, kind]] of Object.entries(extra)) it.attributes[name] = asset.attribute(values, kind);
  if (mode !== undefined) it.mode = mode;
  place(asset, [it]);
  return asset;
}

const moved = { POSITION: [-1, -1, 0, 1, -1, 0, 1.5, 1.5, 1, -1, 1, 0] };

// The third position of a square, moved by a sparse accessor.
function sparse(view) {
  const asset = made({ ...square(), POSITION: view ? square().POSITION : moved.POSITION });
  const index = first(asset).attributes.POSITION;
  const accessor = asset.json.accessors[index];
  const from = view ? [2] : [0, 1, 2, 3];
  const values = view ? moved.POSITION.slice(6, 9) : moved.POSITION;
  const indices = asset.view(Buffer.from(Uint8Array.from(from)));
  const data = asset.view(Buffer.from(Float32Array.from(values).buffer));
  accessor.sparse = { count: from.length, indices: { bufferView: indices, componentType: 5121 }, values: { bufferView: data } };
  Object.assign(accessor, asset.bounds(Float32Array.from(moved.POSITION), 3));
  if (view) return { asset, twin: made({ ...square(), ...moved }), same: ['corners'] };
  const unused = accessor.bufferView;
  delete accessor.bufferView;
  asset.json.bufferViews[unused] = asset.json.bufferViews.pop();
  accessor.sparse.values.bufferView = unused;
  return { asset, twin: made({ ...square(), ...moved }), same: ['corners'] };
}

function zeros() {
  const twin = made(square(), { COLOR_0: [Array(12).fill(0), {}] });
  const asset = made(square());
  first(asset).attributes.COLOR_0 = asset.add('accessors', { componentType: 5126, type: 'VEC3', count: 4 });
  return { asset, twin, same: ['corners'] };
}

function interleaved() {
  const shape = square();
  const asset = made(shape);
  const bytes = Buffer.alloc(4 * 24);
  for (let i = 0; i < 4; ++i)
    [...shape.POSITION.slice(i * 3, i * 3 + 3), ...shape.NORMAL.slice(i * 3, i * 3 + 3)].forEach((v, c) => bytes.writeFloatLE(v, i * 24 + c * 4));
  // The views of both attributes are one.
  const { POSITION, NORMAL, TEXCOORD_0 } = first(asset).attributes;
  const uv = asset.json.bufferViews[asset.json.accessors[TEXCOORD_0].bufferView];
  const indices = asset.json.bufferViews[asset.json.accessors[first(asset).indices].bufferView];
  const whole = Buffer.concat(asset.bytes);
  const part = view => whole.subarray(view.byteOffset, view.byteOffset + view.byteLength);
  const [uvBytes, indexBytes] = [part(uv), part(indices)];
  asset.bytes = [];
  asset.length = 0;
  asset.json.bufferViews = [];
  const both = asset.view(bytes, { byteStride: 24, target: 34962 });
  Object.assign(asset.json.accessors[POSITION], { bufferView: both });
  Object.assign(asset.json.accessors[NORMAL], { bufferView: both, byteOffset: 12 });
  asset.json.accessors[TEXCOORD_0].bufferView = asset.view(uvBytes, { target: 34962, byteStride: 8 });
  asset.json.accessors[first(asset).indices].bufferView = asset.view(indexBytes, { target: 34963 });
  return { asset, twin: made(shape), same: ['corners'] };
}

// Triangles of the same corners, or the lines of a mode.
const ring = [-1, -1, 0, 1, -1, 0, 1.2, 0.5, 0, 0, 1.4, 0, -1.2, 0.5, 0];
const ringShape = indices => ({ POSITION: ring, NORMAL: Array.from({ length: 5 }, () => [0, 0, 1]).flat(), TEXCOORD_0: Array.from({ length: 5 }, (_, i) => [i / 5, 0]).flat(), indices });
const mode = (code, indices, plainMode, plainIndices) => ({
  asset: made(ringShape(indices), {}, { mode: code }),
  twin: made(ringShape(plainIndices), {}, { mode: plainMode }),
  same: ['corners'],
});

// The corners are the last of more vertices than 16 bits can count.
function manyVertices() {
  const [shape, first] = [square(), 65536];
  const filled = (values, filler) => [...Array.from({ length: first }, () => filler).flat(), ...values];
  const many = { POSITION: filled(shape.POSITION, [0, 0, 0]), NORMAL: filled(shape.NORMAL, [0, 0, 1]), TEXCOORD_0: filled(shape.TEXCOORD_0, [0, 0]), indices: shape.indices.map(i => i + first) };
  return { asset: made(many, {}, { indices: 5125 }), twin: made(shape), same: ['corners'] };
}

// The same square, from positions that single precision holds in steps of 1/4, and a node that moves it back.
function farPositions() {
  const away = 4e6;
  const asset = made({ ...square(), POSITION: square().POSITION.map(v => v + away) });
  asset.json.nodes[0].translation = [-away, -away, -away];
  return { asset, twin: made(square()), same: ['corners'] };
}

const byte = kind => ({ ...kind, normalized: true });
const ramp = [1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0];
const ramp4 = [1, 0, 0, 1, 0, 1, 0, 0.2, 0, 0, 1, 1, 1, 1, 0, 0.6];
const scaled = (values, scale) => values.map(v => Math.round(v * scale));
const uv = [0, 1, 1, 1, 1, 0, 0, 0];

// COLOR_0 in integers must equal COLOR_0 as floats.
const colored = (values, kind, plainKind, scale) => ({
  asset: made(square(), { COLOR_0: [scaled(values, scale), byte(kind)] }),
  twin: made(square(), { COLOR_0: [scaled(values, scale).map(v => v / scale), plainKind] }),
  same: ['corners'],
});
const uvs = (componentType, scale) => ({
  asset: remake({ TEXCOORD_0: [scaled(uv, scale), { type: 'VEC2', componentType, normalized: true }] }),
  twin: remake({ TEXCOORD_0: [uv, { type: 'VEC2' }] }),
  same: ['corners'],
});
const remake = extra => made(square(), extra, { only: ['POSITION', 'NORMAL'] });
const withAttribute = (name, values, kind, before = {}) => ({ asset: made(square(), { ...before, [name]: [values, kind] }), twin: made(square(), before) });
const sets = n => Object.fromEntries(Array.from({ length: n }, (_, i) => [`TEXCOORD_${i + 1}`, [uv.map(v => v * 0.5), { type: 'VEC2' }]]));

// A primitive with morph targets that move its third corner, the last the farthest.
function morphed(count, { names = ['POSITION'], weights } = {}) {
  const asset = made(square(), {}, { only: ['POSITION', 'NORMAL', 'TANGENT', 'TEXCOORD_0'] });
  const delta = (i, width) => Array.from({ length: 4 * width }, (_, k) => (k === 2 * width ? 0.1 * (i + 1) : 0));
  const types = { POSITION: {}, NORMAL: {}, TANGENT: {}, TEXCOORD_0: { type: 'VEC2' }, COLOR_0: { type: 'VEC4' } };
  first(asset).targets = Array.from({ length: count }, (_, i) => Object.fromEntries(
    names.map(name => [name, asset.attribute(delta(i, name === 'COLOR_0' ? 4 : name === 'TEXCOORD_0' ? 2 : 3), { ...types[name], bounds: name === 'POSITION' })])));
  if (weights) mesh(asset).weights = weights;
  return asset;
}
const last = count => Array.from({ length: count }, (_, i) => (i === count - 1 ? 1 : 0));
const over = n => ({ asset: morphed(n + 1, { weights: last(n + 1) }), twin: morphed(n, { weights: Array(n).fill(0) }), differs: ['morphs'] });
const morphAttribute = (name, extra = {}) => {
  const make = names => morphed(1, { names, weights: [1] });
  const [asset, twin] = [make(['POSITION', name]), make(['POSITION'])];
  for (const it of [asset, twin])
    for (const [attribute, [values, kind]] of Object.entries(extra)) first(it).attributes[attribute] = it.attribute(values, kind);
  return { asset, twin };
};
const sparseMorph = () => {
  const [asset, like] = [morphed(1, { weights: [1] }), morphed(1, { weights: [1] })];
  const accessor = asset.json.accessors[first(asset).targets[0].POSITION];
  const indices = asset.view(Buffer.from([2]));
  const data = asset.view(Buffer.from(Float32Array.from([0.5, 0.2, 0.7]).buffer));
  accessor.sparse = { count: 1, indices: { bufferView: indices, componentType: 5121 }, values: { bufferView: data } };
  Object.assign(accessor, { min: [0, 0, 0], max: [Math.fround(0.5), Math.fround(0.2), Math.fround(0.7)] });
  return { asset, twin: like };
};

// A square bound to a chain of joints: the second turned.
export function skinned(joints = 2, { weights = [1, 0, 0, 0], more, matrices = true, joint = 5121, weight = 5126, turn = [0, 0, 0.5, Math.sqrt(0.75)] } = {}) {
  const scale = { 5121: 255, 5123: 65535, 5126: 1 }[weight];
  const ids = [[0, 1], [joints - 1, 0], [joints - 1, 0], [0, 1]].flatMap(pair => [...pair, 0, 0]);
  const extra = {
    JOINTS_0: [ids, { type: 'VEC4', componentType: joint }],
    WEIGHTS_0: [Array.from({ length: 4 }, () => weights.map(v => Math.round(v * scale * 1000) / 1000)).flat(), { type: 'VEC4', componentType: weight, ...(weight !== 5126 && { normalized: true }) }],
    ...more,
  };
  const asset = made(square(), extra);
  const nodes = Array.from({ length: joints }, (_, i) => asset.add('nodes', { name: `Joint${i}`, ...(i === joints - 1 && { rotation: turn, translation: [0.1, 0.2, 0] }) }));
  const matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.25, 0, 0, 1];
  const skin = { name: 'Skin', joints: nodes };
  if (matrices) skin.inverseBindMatrices = asset.accessor(nodes.flatMap(() => matrix), { type: 'MAT4' });
  asset.json.nodes[0].skin = asset.add('skins', skin);
  asset.json.scenes[0].nodes.push(asset.add('nodes', { name: 'Root', children: nodes }));
  return asset;
}
const skins = (asset, twin, ...same) => ({ asset, twin, ...(same.length && { same }) });
const unskinned = asset => {
  delete asset.json.nodes[0].skin;
  delete asset.json.skins;
  for (const name of ['JOINTS_0', 'WEIGHTS_0']) delete first(asset).attributes[name];
  return asset;
};
const each = values => Array.from({ length: 4 }, () => values).flat();
const four = ids => ({ JOINTS_0: [each(ids), { type: 'VEC4', componentType: 5121 }] });
// Eight influences, none of which can be left out: only the last joint moves.
const eight = (first, second) => ({ ...four(first), JOINTS_1: four(second).JOINTS_0, WEIGHTS_1: [each([0.1, 0.1, 0.1, 0.1]), { type: 'VEC4' }] });
// Two joints of one name: the second of them is turned.
const namedAlike = (asset, name) => {
  asset.json.nodes[asset.json.skins[0].joints.at(-1)].name = name;
  return asset;
};

export const geometry = {
  'accessor.sparse': () => sparse(true),
  'accessor.sparse-only': () => sparse(false),
  'accessor.zeros': zeros,
  'accessor.interleaved': interleaved,
  'index.none': () => ({ asset: made({ ...square(), ...unrolled() }, {}, { indices: 0 }), twin: made(square()), same: ['corners'] }),
  'index.uint8': () => ({ asset: made(square(), {}, { indices: 5121 }), twin: made(square()), same: ['corners'] }),
  'index.uint16': () => ({ asset: made(square()), twin: made({ ...square(), ...unrolled() }, {}, { indices: 0 }), same: ['corners'] }),
  'index.uint32': () => ({ asset: made(square(), {}, { indices: 5125 }), twin: made(square()), same: ['corners'] }),
  'primitive.vertices-over-65536': manyVertices,
  'primitive.points': () => ({ ...mode(0, [0, 1, 2, 3, 4], 4, [0, 1, 2]), same: undefined, differs: ['points'] }),
  'primitive.lines': () => ({ ...mode(1, [0, 1, 2, 3], 4, [0, 1, 2]), same: undefined, differs: ['lines'] }),
  'primitive.line-loop': () => mode(2, [0, 1, 2, 3], 1, [0, 1, 1, 2, 2, 3, 3, 0]),
  'primitive.line-strip': () => mode(3, [0, 1, 2, 3], 1, [0, 1, 1, 2, 2, 3]),
  'primitive.triangle-strip': () => mode(5, [0, 1, 4, 2, 3], 4, [0, 1, 4, 1, 2, 4, 4, 2, 3]),
  'primitive.triangle-fan': () => mode(6, [0, 1, 2, 3, 4], 4, [0, 1, 2, 0, 2, 3, 0, 3, 4]),
  'primitive.no-material': () => twinned(() => model(), asset => { delete first(asset).material; }),
  'primitive.no-normals': () => ({ asset: model({ only: ['POSITION', 'TEXCOORD_0'] }), twin: flat(), same: [] }),
  'primitive.no-positions': () => twinned(() => model(), asset => {
    const attributes = { _ID: asset.attribute([1, 2, 3], { type: 'SCALAR' }) };
    mesh(asset).primitives.push({ attributes, material: 0 });
  }),
  'mesh.several-primitives': () => twinned(() => model(), asset => mesh(asset).primitives.push(primitive(asset, square(0.5, 2)))),
  'mesh.attributes-shared': () => ({ asset: shared(), twin: model({ shape: square() }), same: ['corners'] }),
  'attribute.position-over-million': farPositions,
  'attribute.texcoord-1': () => withAttribute('TEXCOORD_1', uv, { type: 'VEC2' }),
  'attribute.texcoord-2': () => withAttribute('TEXCOORD_2', uv, { type: 'VEC2' }, sets(1)),
  'attribute.texcoord-4': () => withAttribute('TEXCOORD_4', uv, { type: 'VEC2' }, sets(3)),
  'attribute.texcoord-uint8': () => uvs(5121, 255),
  'attribute.texcoord-uint16': () => uvs(5123, 65535),
  'attribute.color-0': () => withAttribute('COLOR_0', ramp, {}),
  'attribute.color-0-alpha': () => ({ asset: made(square(), { COLOR_0: [ramp4, { type: 'VEC4' }] }, { material: { alphaMode: 'BLEND' } }),
    twin: made(square(), { COLOR_0: [ramp4.map((v, i) => (i % 4 === 3 ? 1 : v)), { type: 'VEC4' }] }, { material: { alphaMode: 'BLEND' } }) }),
  'attribute.color-uint8': () => colored(ramp4, { type: 'VEC4', componentType: 5121 }, { type: 'VEC4' }, 255),
  'attribute.color-uint16': () => colored(ramp4, { type: 'VEC4', componentType: 5123 }, { type: 'VEC4' }, 65535),
  'attribute.color-1': () => withAttribute('COLOR_1', ramp, {}, { COLOR_0: [ramp, {}] }),
  'attribute.custom': () => withAttribute('_HEAT', [1, 2, 3, 4], { type: 'SCALAR' }),
  'attribute.tangent': () => withAttribute('TANGENT', square().TANGENT, kinds.TANGENT),
  'attribute.joints-uint16': () => skins(skinned(2, { joint: 5123 }), skinned(2), 'skin'),
  'attribute.weights-uint8': () => skins(skinned(2, { weight: 5121, weights: [0.2, 0.8, 0, 0] }), skinned(2, { weights: [0.2, 0.8, 0, 0] }), 'skin'),
  'attribute.weights-uint16': () => skins(skinned(2, { weight: 5123, weights: [0.2, 0.8, 0, 0] }), skinned(2, { weights: [0.2, 0.8, 0, 0] }), 'skin'),
  'attribute.joints-1': () => skins(skinned(9, { weights: [0.3, 0.1, 0.1, 0.1], more: eight([8, 0, 1, 2], [3, 4, 5, 6]) }), skinned(9, { weights: [0.3, 0.7, 0, 0], more: four([8, 0, 0, 0]) }), 'skin'),
  'morph.target': () => ({ asset: morphed(1, { weights: [1] }), twin: made(square(), {}, { only: ['POSITION', 'NORMAL', 'TANGENT', 'TEXCOORD_0'] }) }),
  ...Object.fromEntries([4, 8, 16, 32].map(n => [`morph.targets-over-${n}`, () => over(n)])),
  'morph.normal': () => morphAttribute('NORMAL'),
  'morph.tangent': () => morphAttribute('TANGENT'),
  'morph.texcoord': () => morphAttribute('TEXCOORD_0'),
  'morph.color': () => morphAttribute('COLOR_0', { COLOR_0: [ramp4, { type: 'VEC4' }] }),
  'morph.sparse': sparseMorph,
  'morph.mesh-weights': () => ({ asset: morphed(2, { weights: [0.3, 1] }), twin: morphed(2) }),
  'morph.node-weights': () => twinned(() => morphed(2, { weights: [0, 0] }), asset => { asset.json.nodes[0].weights = [0.3, 1]; }),
  'morph.target-names': () => twinned(() => morphed(2), asset => { mesh(asset).extras = { targetNames: ['smile', 'frown'] }; }),
  'skin.joints': () => skins(skinned(2), unskinned(skinned(2))),
  'skin.joint-name-doubled': () => skins(namedAlike(skinned(2), 'Joint0'), skinned(2), 'skin'),
  'skin.joints-over-64': () => skins(skinned(65), unskinned(skinned(65))),
  'skin.joints-over-256': () => skins(skinned(257, { joint: 5123 }), unskinned(skinned(257, { joint: 5123 }))),
  'skin.no-inverse-bind-matrices': () => skins(skinned(2, { matrices: false }), unskinned(skinned(2, { matrices: false }))),
  'skin.transformed-mesh': () => ({ ...twinned(() => skinned(2), asset => { asset.json.nodes[0].translation = [0.5, 0.5, 0]; }), same: [] }),
  'skin.shared': () => twinned(() => twoOf(skinned(2)), asset => { asset.json.nodes.at(-1).skin = 0; }),
};

function unrolled() {
  const shape = square();
  const pick = (values, width) => shape.indices.flatMap(i => values.slice(i * width, (i + 1) * width));
  return { POSITION: pick(shape.POSITION, 3), NORMAL: pick(shape.NORMAL, 3), TEXCOORD_0: pick(shape.TEXCOORD_0, 2) };
}

function shared() {
  const asset = model({ shape: square() });
  const { indices, ...rest } = first(asset);
  mesh(asset).primitives = [[0, 1, 2], [0, 2, 3]].map(part => ({ ...rest, indices: asset.indices(part) }));
  asset.json.accessors.splice(indices, 1);
  for (const it of mesh(asset).primitives) it.indices -= 1;
  return asset;
}

function twoOf(asset) {
  const { attributes, indices, material } = first(asset);
  const node = asset.add('nodes', { name: 'Other', mesh: asset.add('meshes', { name: 'Other', primitives: [{ attributes, indices, material }] }) });
  asset.json.scenes[0].nodes.push(node);
  return asset;
}

// The sphere with a normal for each triangle.
function flat() {
  const shape = sphere();
  const out = { POSITION: [], NORMAL: [], TEXCOORD_0: [] };
  for (let i = 0; i < shape.indices.length; i += 3) {
    const [a, b, c] = shape.indices.slice(i, i + 3).map(v => shape.POSITION.slice(v * 3, v * 3 + 3));
    const [u, v] = [b.map((x, k) => x - a[k]), c.map((x, k) => x - a[k])];
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...normal);
    for (const v of shape.indices.slice(i, i + 3)) {
      out.POSITION.push(...shape.POSITION.slice(v * 3, v * 3 + 3));
      out.NORMAL.push(...normal.map(x => x / length));
      out.TEXCOORD_0.push(...shape.TEXCOORD_0.slice(v * 2, v * 2 + 2));
    }
  }
  return made(out, {}, { indices: 0 });
}

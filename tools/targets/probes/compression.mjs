// SPDX-License-Identifier: Apache-2.0
// Probes of compressed geometry. The encoders are npm's, below build/.
import { createRequire } from 'node:module';
import { model, sphere } from './models.mjs';

const require = createRequire(new URL('../../../build/targets/npm/tools/', import.meta.url));
const draco3d = await require('draco3dgltf').createEncoderModule({});
const { MeshoptEncoder } = require('meshoptimizer');
await MeshoptEncoder.ready;

const twin = () => model();

function dracoBytes(shape, attributes) {
  const encoder = new draco3d.Encoder();
  const builder = new draco3d.MeshBuilder();
  const mesh = new draco3d.Mesh();
  const ids = {};
  const types = { POSITION: draco3d.POSITION, NORMAL: draco3d.NORMAL, TEXCOORD_0: draco3d.TEX_COORD };
  const count = shape.POSITION.length / 3;
  builder.AddFacesToMesh(mesh, shape.indices.length / 3, new Uint32Array(shape.indices));
  for (const name of attributes)
    ids[name] = builder.AddFloatAttributeToMesh(mesh, types[name], count, shape[name].length / count, new Float32Array(shape[name]));
  encoder.SetEncodingMethod(draco3d.MESH_SEQUENTIAL_ENCODING);
  encoder.SetSpeedOptions(10, 10);
  const out = new draco3d.DracoInt8Array();
  const length = encoder.EncodeMeshToDracoBuffer(mesh, out);
  const bytes = Buffer.from(Array.from({ length }, (_, i) => out.GetValue(i)));
  return { bytes, ids };
}

function draco(fallback) {
  const asset = model();
  const primitive = asset.json.meshes[0].primitives[0];
  const { bytes, ids } = dracoBytes(sphere(), Object.keys(primitive.attributes));
  const bufferView = asset.view(bytes);
  primitive.extensions = { KHR_draco_mesh_compression: { bufferView, attributes: ids } };
  if (!fallback) {
    for (const index of [...Object.values(primitive.attributes), primitive.indices]) delete asset.json.accessors[index].bufferView;
    // Removes bytes that the accessors no longer use.
    const kept = asset.json.bufferViews[bufferView];
    asset.json.bufferViews = [{ ...kept, byteOffset: 0 }];
    primitive.extensions.KHR_draco_mesh_compression.bufferView = 0;
    asset.bytes = [bytes];
    asset.length = bytes.length;
  }
  return { asset, twin: twin(), same: ['corners'] };
}

// With a fallback, the uncompressed bytes are in the first buffer, the compressed ones in the second.
function meshopt(name, fallback) {
  const asset = model();
  const whole = Buffer.concat(asset.bytes);
  const streams = [];
  let offset = 0;
  for (const view of asset.json.bufferViews) {
    const raw = whole.subarray(view.byteOffset, view.byteOffset + view.byteLength);
    const vertices = view.target === 34962;
    const stride = vertices ? view.byteStride ?? view.byteLength / 117 : 2;
    const bytes = Buffer.from(MeshoptEncoder.encodeGltfBuffer(raw, view.byteLength / stride, stride, vertices ? 'ATTRIBUTES' : 'TRIANGLES', 0));
    view.extensions = { [name]: { buffer: 1, byteOffset: offset, byteLength: bytes.length, byteStride: stride, count: view.byteLength / stride, mode: vertices ? 'ATTRIBUTES' : 'TRIANGLES' } };
    const padded = Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4)]);
    streams.push(padded);
    offset += padded.length;
  }
  const bytes = Buffer.concat(streams);
  asset.json.buffers = [{ byteLength: bytes.length, uri: 'compressed.bin' }];
  asset.files.set('compressed.bin', bytes);
  if (!fallback) {
    // The buffer of the uncompressed bytes is missing.
    asset.json.buffers = [{ byteLength: asset.length, extensions: { [name]: { fallback: true } } }, ...asset.json.buffers];
    asset.bytes = [];
  }
  return { asset, twin: twin(), same: ['corners'] };
}

const ways = make => ({ used: () => make(true), required: () => make(false), requiredWithFallback: () => make(true) });
export const compressed = { draco: ways(draco), meshopt: name => ways(fallback => meshopt(name, fallback)) };

// Positions in normalized 16-bit integers and normals in 8 bits. The sphere has radius 1, so that no node scales it.
export function quantized() {
  const shape = sphere();
  const asset = model();
  const round = (values, scale) => values.map(v => Math.round(v * scale));
  asset.json.bufferViews = [];
  asset.json.accessors = [];
  asset.bytes = [];
  asset.length = 0;
  const attributes = {
    POSITION: asset.attribute(round(shape.POSITION, 32767), { componentType: 5122, normalized: true, bounds: true }),
    NORMAL: asset.attribute(round(shape.NORMAL, 127), { componentType: 5120, normalized: true }),
    TEXCOORD_0: asset.attribute(shape.TEXCOORD_0, { type: 'VEC2' }),
  };
  asset.json.meshes[0].primitives[0] = { attributes, indices: asset.indices(shape.indices), material: 0 };
  const exact = { ...shape, POSITION: round(shape.POSITION, 32767).map(v => v / 32767), NORMAL: round(shape.NORMAL, 127).map(v => v / 127) };
  return { asset, twin: model({ shape: exact }), same: ['corners'] };
}

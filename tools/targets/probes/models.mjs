// SPDX-License-Identifier: Apache-2.0
// The models of the probes. Each shows the feature that a probe adds: a sphere with normals, tangents and texture
// coordinates, lit by the light of the viewer.
import { Asset } from './asset.mjs';
import { png, quadrants } from './png.mjs';

const columns = 12;
const rows = 8;

// A sphere about the origin: values by attribute, and indices of triangles.
export function sphere(radius = 1) {
  const shape = { POSITION: [], NORMAL: [], TANGENT: [], TEXCOORD_0: [], indices: [] };
  for (let row = 0; row <= rows; ++row)
    for (let column = 0; column <= columns; ++column) {
      const [u, v] = [column / columns, row / rows];
      const [phi, theta] = [u * 2 * Math.PI, v * Math.PI];
      const normal = [-Math.cos(phi) * Math.sin(theta), Math.cos(theta), Math.sin(phi) * Math.sin(theta)];
      shape.POSITION.push(...normal.map(x => x * radius));
      shape.NORMAL.push(...normal);
      shape.TANGENT.push(Math.sin(phi), 0, Math.cos(phi), 1);
      shape.TEXCOORD_0.push(u, v);
    }
  const at = (row, column) => row * (columns + 1) + column;
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const [a, b, c, d] = [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
      if (row < rows - 1) shape.indices.push(a, b, c);
      if (row > 0) shape.indices.push(a, c, d);
    }
  return shape;
}

// A square in the xy plane that faces +z.
export function square(half = 1, z = 0) {
  return {
    POSITION: [-half, -half, z, half, -half, z, half, half, z, -half, half, z],
    NORMAL: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1],
    TANGENT: [1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1],
    TEXCOORD_0: [0, 1, 1, 1, 1, 0, 0, 0],
    indices: [0, 1, 2, 0, 2, 3],
  };
}

export const kinds = { POSITION: { bounds: true }, NORMAL: {}, TANGENT: { type: 'VEC4' }, TEXCOORD_0: { type: 'VEC2' } };

// The accessors of a shape as a primitive.
export function primitive(asset, shape, { only = ['POSITION', 'NORMAL', 'TEXCOORD_0'], material = 0, indices = 5123 } = {}) {
  const attributes = {};
  for (const name of only) attributes[name] = asset.attribute(shape[name], kinds[name]);
  return {
    attributes,
    ...(indices && { indices: asset.indices(shape.indices, indices) }),
    ...(material !== undefined && { material }),
  };
}

// A node with a mesh of these primitives, in the scene.
export function place(asset, primitives, node = {}, mesh = {}) {
  const index = asset.add('nodes', { name: `Node${asset.json.nodes?.length ?? 0}`, ...node,
    mesh: asset.add('meshes', { name: `Mesh${asset.json.meshes?.length ?? 0}`, ...mesh, primitives }) });
  asset.json.scene ??= 0;
  asset.json.scenes ??= [{ name: 'Scene', nodes: [] }];
  asset.json.scenes[0].nodes.push(index);
  return index;
}

export const plain = () => ({ name: 'Surface', pbrMetallicRoughness: { baseColorFactor: [0.7, 0.5, 0.3, 1], metallicFactor: 0, roughnessFactor: 0.4 } });

// A shape with a material. material: members beside or in place of those of plain().
export function model({ material = {}, shape = sphere(), only, node, mesh, indices } = {}) {
  const asset = new Asset();
  asset.add('materials', { ...plain(), ...structuredClone(material) });
  place(asset, [primitive(asset, shape, { only, indices })], node, mesh);
  return asset;
}

// Adds a texture of four colors, or of an image; returns its index.
export function texture(asset, { image = colors(), uri = 'colors.png', sampler, mimeType } = {}) {
  return asset.add('textures', {
    source: asset.image(image, uri, { ...(mimeType && { mimeType }) }),
    ...(sampler && { sampler: asset.add('samplers', sampler) }),
  });
}
export const sharp = { magFilter: 9728, minFilter: 9728 };  // without blur, which depends on the size of an image
export const colors = (size = [16, 16]) => png({ size, at: quadrants(size) });

// A model whose base color comes from a texture. slot: members of the texture slot.
export function textured({ slot = {}, ...rest } = {}, of = {}) {
  const asset = model({ shape: square(), ...of });
  asset.json.materials[0].pbrMetallicRoughness.baseColorFactor = [1, 1, 1, 1];
  asset.json.materials[0].pbrMetallicRoughness.baseColorTexture = { index: texture(asset, rest), ...slot };
  return asset;
}

// An object behind the model, for materials that transmit light.
export function backdrop(asset) {
  const shape = square(3, -3);
  const material = asset.add('materials', { name: 'Backdrop', pbrMetallicRoughness: { metallicFactor: 0, baseColorTexture: { index: texture(asset, { uri: 'backdrop.png' }) } } });
  place(asset, [primitive(asset, shape, { material })]);
  return asset;
}

// SPDX-License-Identifier: Apache-2.0
// Builds small assets: one buffer, and files beside it.
import { createHash } from 'node:crypto';

const arrays = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
export const widths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 };
const bytesOf = typed => Buffer.from(typed.buffer, typed.byteOffset, typed.byteLength);

export class Asset {
  constructor() {
    this.json = { asset: { version: '2.0', generator: 'gltfx targets' } };
    this.bytes = [];
    this.length = 0;
    this.files = new Map();  // name of a file beside the asset: its bytes
  }

  // Appends to an array of the document; returns the index.
  add(array, object) {
    this.json[array] ??= [];
    return this.json[array].push(object) - 1;
  }

  // Names an extension in the document.
  uses(name, required = false) {
    for (const list of required ? ['extensionsUsed', 'extensionsRequired'] : ['extensionsUsed']) {
      this.json[list] ??= [];
      if (!this.json[list].includes(name)) this.json[list].push(name);
    }
    return this;
  }

  // A new buffer view of bytes of the buffer.
  view(bytes, members = {}) {
    const padding = (4 - (this.length % 4)) % 4;
    this.bytes.push(Buffer.alloc(padding), bytes);
    const byteOffset = this.length + padding;
    this.length = byteOffset + bytes.length;
    return this.add('bufferViews', { buffer: 0, byteOffset, byteLength: bytes.length, ...members });
  }

  // An accessor of its own buffer view. kind: { type, componentType, normalized, bounds, target, stride, plain }.
  accessor(values, kind) {
    const { type = 'VEC3', componentType = 5126, normalized, bounds = false, target, stride } = kind;
    const width = widths[type];
    const size = arrays[componentType].BYTES_PER_ELEMENT;
    const step = stride ?? (target === 34962 ? Math.ceil((width * size) / 4) * 4 : width * size);
    const count = values.length / width;
    const bytes = Buffer.alloc(step * count);
    for (let i = 0; i < count; ++i)
      bytesOf(arrays[componentType].from(values.slice(i * width, (i + 1) * width))).copy(bytes, i * step);
    const view = this.view(bytes, { ...(target && { target }), ...(target === 34962 && step !== width * size && { byteStride: step }) });
    return this.add('accessors', {
      bufferView: view, componentType, count, type,
      ...(normalized && { normalized: true }),
      ...(bounds && this.bounds(arrays[componentType].from(values), width)),
    });
  }

  bounds(values, width) {
    const column = c => Array.from(values).filter((_, i) => i % width === c);
    const each = f => Array.from({ length: width }, (_, c) => column(c).reduce((a, b) => f(a, b)));
    return { min: each(Math.min), max: each(Math.max) };
  }

  attribute(values, kind) { return this.accessor(values, { ...kind, target: 34962 }); }
  indices(values, componentType = 5123) { return this.accessor(values, { type: 'SCALAR', componentType, target: 34963 }); }

  // An image file beside the asset.
  image(bytes, uri, members = {}) {
    this.files.set(decodeURIComponent(uri), bytes);
    return this.add('images', { uri, ...members });
  }

  copy() {
    const other = new Asset();
    other.json = structuredClone(this.json);
    other.bytes = [...this.bytes];
    other.length = this.length;
    other.files = new Map(this.files);
    other.layout = this.layout;
    other.chunks = this.chunks;
    return other;
  }

  // The files of the asset: [name, bytes], the asset itself first. layout: gltf, glb or embedded.
  written() {
    const json = structuredClone(this.json);
    const buffer = Buffer.concat(this.bytes);
    const layout = this.layout ?? 'gltf';
    const files = [...this.files];
    if (buffer.length > 0) {
      json.buffers = [{ byteLength: buffer.length }, ...(json.buffers ?? [])];
      if (layout === 'gltf') {
        json.buffers[0].uri = this.bufferUri ?? 'data.bin';
        files.push([decodeURIComponent(json.buffers[0].uri).replace(/^(http:\/\/[^/]*|\.)\//, ''), buffer]);
      } else if (layout === 'embedded') {
        json.buffers[0].uri = `data:${this.bufferType ?? 'application/octet-stream'};base64,${buffer.toString('base64')}`;
      }
    }
    const text = Buffer.from(JSON.stringify(json));
    if (layout !== 'glb') return [['asset.gltf', text], ...files];
    return [['asset.glb', glb([['JSON', text], ...(buffer.length ? [['BIN\0', buffer]] : []), ...(this.chunks ?? [])])], ...files];
  }

  // The same for the same files.
  digest() {
    const hash = createHash('sha256');
    for (const [name, bytes] of this.written()) hash.update(`${name} ${bytes.length}\n`).update(bytes);
    return hash.digest('hex').slice(0, 20);
  }
}

function glb(chunks) {
  const parts = chunks.map(([type, data]) => {
    const padded = Buffer.concat([data, Buffer.alloc((4 - (data.length % 4)) % 4, type === 'JSON' ? 0x20 : 0)]);
    const head = Buffer.alloc(8);
    head.writeUInt32LE(padded.length);
    head.write(type, 4, 'latin1');
    return Buffer.concat([head, padded]);
  });
  const head = Buffer.alloc(12);
  head.write('glTF', 0, 'latin1');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + parts.reduce((sum, part) => sum + part.length, 0), 8);
  return Buffer.concat([head, ...parts]);
}

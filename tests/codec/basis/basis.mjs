// SPDX-License-Identifier: Apache-2.0
// What the scripts of this folder share: pictures, PNG files, Binomial's encoder and transcoder.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { deflateSync } from 'node:zlib';

// --- Images: from (x, y) and a random number, 0 to 1, to R, G, B, A from 0 to 1 ---

let seed = 1;
export function random() {  // the same numbers each time
  seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
  return seed / 2 ** 32;
}

const waves = (x, y, f) => Math.sin(f * x + 3 * y) * Math.cos(f * y - 2 * x * y) / 2 + 0.5;
export const pictures = {
  flat: () => [0.8, 0.3, 0.1, 1],
  gradient: (x, y) => [x, y, 1 - x, 1],
  noise: () => [random(), random(), random(), random()],
  grey: (x, y) => Array(3).fill(waves(x, y, 20)).concat(1),
  photo: (x, y) => [waves(x, y, 7) * 0.8 + random() * 0.1, waves(y, x, 11), waves(x + y, y, 5) * 0.6 + 0.2, 1],
  leaf: (x, y) => [0.2, 0.4 + 0.5 * waves(x, y, 9), 0.1, Math.hypot(x - 0.5, y - 0.5) < 0.4 ? 1 : 0],
  smoke: (x, y) => [0.5 + 0.4 * waves(x, y, 4), 0.5, 0.5, waves(y, x, 13)],
  checker: (x, y) => ((Math.floor(x * 8) ^ Math.floor(y * 8)) & 1 ? [1, 1, 1, 1] : [0.05, 0, 0.3, 0.5]),
  orm: (x, y) => [0.7 + 0.3 * waves(x, y, 6), waves(y, x, 31), waves(x, y, 12) > 0.6 ? 1 : 0, 1],
  normals: (x, y) => {
    const [a, b] = [Math.cos(20 * x) * 0.4, Math.sin(17 * y) * 0.4];
    const length = Math.hypot(a, b, 1);
    return [a / length, b / length, 1 / length].map((v) => v / 2 + 0.5).concat(1);
  },
};

export function paint(picture, width, height) {
  const data = new Uint8Array(width * height * 4);
  for (let i = 0; i < width * height; ++i) {
    const color = pictures[picture](((i % width) + 0.5) / width, (Math.floor(i / width) + 0.5) / height);
    for (let c = 0; c < 4; ++c) data[4 * i + c] = Math.round(255 * color[c]);
  }
  return { data, width, height };
}

// --- PNG ---

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc >>> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
  }
  return ~crc >>> 0;
}

export function png({ data, width, height }) {
  const rows = Buffer.alloc(height * (width * 4 + 1));
  for (let y = 0; y < height; ++y) {
    Buffer.from(data.buffer, data.byteOffset + y * width * 4, width * 4).copy(rows, y * (width * 4 + 1) + 1);
  }
  const chunk = (name, body) => {
    const bytes = Buffer.concat([Buffer.alloc(4), Buffer.from(name), body, Buffer.alloc(4)]);
    bytes.writeUInt32BE(body.length, 0);
    bytes.writeUInt32BE(crc32(bytes.subarray(4, -4)), bytes.length - 4);
    return bytes;
  };
  const header = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, 8, 6, 0, 0, 0]);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', header),
    chunk('IDAT', deflateSync(rows, { level: 9 })), chunk('IEND', Buffer.alloc(0))]);
}

// --- Encoder and transcoder ---

// An old script, which is not a module although its package declares modules.
async function loadTranscoder(inside, folder) {
  const source = inside('three/examples/jsm/libs/basis/basis_transcoder');
  const copy = path.resolve(folder, 'basis_transcoder.cjs');
  writeFileSync(copy, readFileSync(`${source}.js`));
  const module = await createRequire(import.meta.url)(copy)({ wasmBinary: readFileSync(`${source}.wasm`) });
  module.initializeBasis();
  return module;
}

export const formats = { etc1: 0, etc2: 1, rgba32: 13 };  // of the transcoder

// The texels or blocks of all levels of a file, with their sizes.
function transcodeWith(transcoder, name, bytes, format) {
  const file = new transcoder.KTX2File(new Uint8Array(bytes));
  if (!file.isValid() || !file.startTranscoding()) throw new Error(`${name}: the transcoder refuses it`);
  const levels = [];
  for (let level = 0; level < file.getLevels(); ++level) {
    const { origWidth: width, origHeight: height } = file.getImageLevelInfo(level, 0, 0);
    const data = new Uint8Array(file.getImageTranscodedSizeInBytes(level, 0, 0, format));
    if (!file.transcodeImage(data, level, 0, 0, format, 0, -1, -1)) throw new Error(`${name}: level ${level}`);
    levels.push({ data, width, height });
  }
  file.close();
  file.delete();
  return levels;
}

// MODULES has the npm packages ktx2-encoder and three. `folder` exists.
export async function loadBasis(modules, folder) {
  const inside = (...names) => path.resolve(modules, 'node_modules', ...names);
  const { encodeToKTX2 } = await import(pathToFileURL(inside('ktx2-encoder/dist/node/index.js')));
  const transcoder = await loadTranscoder(inside, folder);
  const counts = { files: 0, levels: 0, texels: 0 };
  return {
    counts,
    encode: (image, options) => encodeToKTX2(new Uint8Array(1), { imageDecoder: async () => image, ...options }),
    transcode: (name, bytes, format) => transcodeWith(transcoder, name, bytes, format),
    // Writes a file, and for each level the texels that the transcoder decodes.
    keep(name, bytes) {
      writeFileSync(path.join(folder, `${name}.ktx2`), bytes);
      for (const [level, image] of transcodeWith(transcoder, name, bytes, formats.rgba32).entries()) {
        if (image.data.length !== image.width * image.height * 4) throw new Error(`${name}: size of level ${level}`);
        writeFileSync(path.join(folder, `${name}.${level}.png`), png(image));
        counts.levels += 1;
        counts.texels += image.width * image.height;
      }
      counts.files += 1;
    },
  };
}

// SPDX-License-Identifier: Apache-2.0
// Makes KTX2 images in ETC1S and UASTC, and the texels that Binomial's transcoder decodes:
//   node make_truth.mjs MODULES FOLDER [few]
// MODULES has the npm packages ktx2-encoder, with the encoder, and three, with the transcoder. FOLDER gets
// NAME.ktx2 and, for each level, NAME.LEVEL.png in RGBA. `few` makes the small set in this folder.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { deflateSync } from 'node:zlib';

const [modules, folder, few] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const inside = (...names) => path.resolve(modules, 'node_modules', ...names);
const { encodeToKTX2 } = await import(pathToFileURL(inside('ktx2-encoder/dist/node/index.js')));
const transcoder = await loadTranscoder();

// An old script, which is not a module although its package declares modules.
async function loadTranscoder() {
  const source = inside('three/examples/jsm/libs/basis/basis_transcoder');
  const copy = path.resolve(folder, 'basis_transcoder.cjs');
  writeFileSync(copy, readFileSync(`${source}.js`));
  const module = await createRequire(import.meta.url)(copy)({ wasmBinary: readFileSync(`${source}.wasm`) });
  module.initializeBasis();
  return module;
}

// --- Images: from (x, y) and a random number, 0 to 1, to R, G, B, A from 0 to 1 ---

let seed = 1;
function random() {  // the same numbers each time
  seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
  return seed / 2 ** 32;
}

const waves = (x, y, f) => Math.sin(f * x + 3 * y) * Math.cos(f * y - 2 * x * y) / 2 + 0.5;
const pictures = {
  flat: () => [0.8, 0.3, 0.1, 1],
  gradient: (x, y) => [x, y, 1 - x, 1],
  noise: () => [random(), random(), random(), random()],
  grey: (x, y) => Array(3).fill(waves(x, y, 20)).concat(1),
  photo: (x, y) => [waves(x, y, 7) * 0.8 + random() * 0.1, waves(y, x, 11), waves(x + y, y, 5) * 0.6 + 0.2, 1],
  leaf: (x, y) => [0.2, 0.4 + 0.5 * waves(x, y, 9), 0.1, Math.hypot(x - 0.5, y - 0.5) < 0.4 ? 1 : 0],
  smoke: (x, y) => [0.5 + 0.4 * waves(x, y, 4), 0.5, 0.5, waves(y, x, 13)],
  checker: (x, y) => ((Math.floor(x * 8) ^ Math.floor(y * 8)) & 1 ? [1, 1, 1, 1] : [0.05, 0, 0.3, 0.5]),
  normals: (x, y) => {
    const [a, b] = [Math.cos(20 * x) * 0.4, Math.sin(17 * y) * 0.4];
    const length = Math.hypot(a, b, 1);
    return [a / length, b / length, 1 / length].map((v) => v / 2 + 0.5).concat(1);
  },
};

function paint(picture, width, height) {
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

function png({ data, width, height }) {
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

// --- Files and their expected texels ---

const counts = { files: 0, levels: 0, texels: 0 };

function keep(name, bytes) {
  const kRgba32 = 13;
  const file = new transcoder.KTX2File(new Uint8Array(bytes));
  if (!file.isValid() || !file.startTranscoding()) throw new Error(`${name}: the transcoder refuses it`);
  writeFileSync(path.join(folder, `${name}.ktx2`), bytes);
  for (let level = 0; level < file.getLevels(); ++level) {
    const { origWidth: width, origHeight: height } = file.getImageLevelInfo(level, 0, 0);
    const data = new Uint8Array(file.getImageTranscodedSizeInBytes(level, 0, 0, kRgba32));
    if (!file.transcodeImage(data, level, 0, 0, kRgba32, 0, -1, -1)) throw new Error(`${name}: level ${level}`);
    if (data.length !== width * height * 4) throw new Error(`${name}: size of level ${level}`);
    writeFileSync(path.join(folder, `${name}.${level}.png`), png({ data, width, height }));
    counts.levels += 1;
    counts.texels += width * height;
  }
  counts.files += 1;
  file.close();
  file.delete();
}

async function make(picture, width, height, options) {
  const bytes = await encodeToKTX2(new Uint8Array(1), { imageDecoder: async () => paint(picture, width, height), ...options });
  const { isUASTC: uastc, qualityLevel: quality, generateMipmap: mipmaps } = options;
  const words = [uastc ? 'uastc' : 'etc1s', picture, `${width}x${height}`, uastc ? options.uastcLDRQualityLevel : quality];
  if (mipmaps) words.push('mipmaps');
  if (!options.isSetKTX2SRGBTransferFunc) words.push('linear');
  if (options.needSupercompression) words.push('zstd');
  if (options.enableRDO) words.push('rdo');
  keep(words.join('-'), bytes);
  return bytes;
}

const etc1s = (quality, mipmaps, srgb = true) =>
  ({ isUASTC: false, qualityLevel: quality, generateMipmap: mipmaps, isSetKTX2SRGBTransferFunc: srgb, isPerceptual: srgb });
const uastc = (level, mipmaps, srgb = true, zstd = false, rdo = false) => ({
  isUASTC: true, uastcLDRQualityLevel: level, generateMipmap: mipmaps, isSetKTX2SRGBTransferFunc: srgb,
  needSupercompression: zstd, enableRDO: rdo, rdoQualityLevel: 2,
});

// Blocks of random bits without reserved modes and patterns: all modes, digits and patterns occur.
async function randomBlocks() {
  const bytes = await encodeToKTX2(new Uint8Array(1),
    { imageDecoder: async () => paint('smoke', few ? 64 : 512, few ? 64 : 512), ...uastc(0, false, false) });
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const offset = Number(view.getBigUint64(80, true));
  const reserved = (block) => {
    const low = block[0] | block[1] << 8 | block[2] << 16 | block[3] << 24;
    const field = (at, bits) => low >>> at & ((1 << bits) - 1);
    if ((low & 0x7F) === 0x45) return true;
    if ((low & 0x1F) === 0x1D || (low & 0x1F) === 0x13) return field(20, 5) >= 30;  // modes 2 and 4
    if ((low & 0x1F) === 0x03) return field(20, 4) >= 11;
    if ((low & 0x1F) === 0x07) return field(20, 5) >= 19;
    if ((low & 0x1F) === 0x0F) return field(28, 4) >= 14;  // mode 9; one bit of its pattern is in the next word
    if ((low & 0x3F) === 0x15) return ((field(29, 3) | (block[4] & 3) << 3) >= 30);
    return false;
  };
  for (let at = offset; at < bytes.length; at += 16) {
    const block = bytes.subarray(at, at + 16);
    do {
      for (let i = 0; i < 16; ++i) block[i] = Math.floor(random() * 256);
    } while (reserved(block));
  }
  keep('uastc-random-blocks', bytes);
}

if (few) {
  await make('photo', 32, 20, etc1s(200, true));
  await make('smoke', 24, 24, etc1s(128, false));
  await make('grey', 16, 16, etc1s(64, false, false));
  await make('leaf', 5, 3, etc1s(255, true));
  await make('noise', 1, 1, etc1s(128, false));
  await make('flat', 64, 64, etc1s(128, false));
  await make('photo', 32, 20, uastc(2, true, true, true));
  await make('smoke', 24, 24, uastc(2, false));
  await make('normals', 16, 16, uastc(3, false, false));
  await make('noise', 5, 3, uastc(2, true, false, true));
  await make('noise', 1, 1, uastc(2, false));
} else {
  const sizes = [[1, 1], [2, 3], [4, 4], [5, 7], [13, 9], [16, 64], [33, 31], [64, 64], [100, 36], [128, 128]];
  for (const picture of Object.keys(pictures)) {
    const color = picture !== 'normals';
    for (const [index, [width, height]] of sizes.entries()) {
      const odd = index % 2 === 1;
      await make(picture, width, height, etc1s([1, 64, 128, 200, 255][index % 5], odd, color));
      await make(picture, width, height, uastc(index % 4, odd, color && index % 3 !== 0, odd, index === 7));
    }
  }
  await make('photo', 512, 512, etc1s(128, true));
  await make('smoke', 512, 384, etc1s(255, true));
  await make('photo', 512, 512, uastc(2, true, true, true));
  await make('smoke', 512, 384, uastc(2, true));
}
await randomBlocks();
console.log(`${counts.files} files, ${counts.levels} levels, ${counts.texels} texels`);

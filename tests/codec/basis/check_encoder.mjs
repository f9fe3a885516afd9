// SPDX-License-Identifier: Apache-2.0
// Compares KTX2 images of gltfx with those of Binomial's encoder, level 2:
//   node check_encoder.mjs MODULES FOLDER GLTFX
// MODULES as in make_truth.mjs. GLTFX is the program. FOLDER gets the images of gltfx and the texels that Binomial's
// transcoder decodes. Fails if a class of pictures has a signal-to-noise ratio more than 1 dB below that of Binomial's
// encoder, or more than 2 dB in the ETC2 blocks that transcoders make with the hints of the encoder.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import path from 'node:path';

import { formats, loadBasis, paint, png } from './basis.mjs';

const [modules, folder, gltfx] = process.argv.slice(2);
const assets = path.join(folder, 'assets');
rmSync(assets, { recursive: true, force: true });
mkdirSync(assets, { recursive: true });
const { counts, encode, keep, transcode } = await loadBasis(modules, folder);

const color = { pbrMetallicRoughness: { baseColorTexture: { index: 0 } } };
const classes = {
  photo: color,
  flat: color,
  gradient: color,
  checker: { ...color, alphaMode: 'BLEND' },
  leaf: { ...color, alphaMode: 'MASK' },
  smoke: { ...color, alphaMode: 'BLEND' },
  normals: { normalTexture: { index: 0 } },
  orm: { pbrMetallicRoughness: { metallicRoughnessTexture: { index: 0 } } },
  grey: { occlusionTexture: { index: 0 } },
};
const sizes = [[1, 1], [3, 5], [4, 4], [30, 17], [64, 64], [256, 256]];

// --- ETC2 with alpha (Khronos Data Format 1.3): blocks that transcoders make use neither T, H nor planar ---

const modifiers = [[2, 8], [5, 17], [9, 29], [13, 42], [18, 60], [24, 80], [33, 106], [47, 183]];
const alphaModifiers = [
  [-3, -6, -9, -15, 2, 5, 8, 14], [-3, -7, -10, -13, 2, 6, 9, 12], [-2, -5, -8, -13, 1, 4, 7, 12],
  [-2, -4, -6, -13, 1, 3, 5, 12], [-3, -6, -8, -12, 2, 5, 7, 11], [-3, -7, -9, -11, 2, 6, 8, 10],
  [-4, -7, -8, -11, 3, 6, 7, 10], [-3, -5, -8, -11, 2, 4, 7, 10], [-2, -6, -8, -10, 1, 5, 7, 9],
  [-2, -5, -8, -10, 1, 4, 7, 9], [-2, -4, -8, -10, 1, 3, 7, 9], [-2, -5, -7, -10, 1, 4, 6, 9],
  [-3, -4, -7, -10, 2, 3, 6, 9], [-1, -2, -3, -10, 0, 1, 2, 9], [-4, -6, -8, -9, 3, 5, 7, 8],
  [-3, -5, -7, -9, 2, 4, 6, 8]];
const limited = (value) => Math.min(Math.max(value, 0), 255);

function etc2Block(bytes, put) {
  const [base, how] = bytes;
  const table = alphaModifiers[how & 15];
  const bits = bytes.subarray(2, 8).reduce((sum, byte) => sum << 8n | BigInt(byte), 0n);
  const color = bytes.subarray(8);
  const differs = (color[3] & 2) !== 0;
  const flipped = (color[3] & 1) !== 0;
  const bases = [[], []];
  for (let c = 0; c < 3; ++c) {
    if (differs) {
      const first = color[c] >> 3;
      const second = first + ((color[c] & 7) ^ 4) - 4;
      for (const [i, five] of [first, second].entries()) bases[i].push(five << 3 | five >> 2);
    } else {
      for (const [i, four] of [color[c] >> 4, color[c] & 15].entries()) bases[i].push(four * 17);
    }
  }
  for (let i = 0; i < 16; ++i) {  // in columns
    const [x, y] = [i >> 2, i & 3];
    const half = (flipped ? y : x) >> 1;
    const [small, large] = modifiers[color[3] >> (half ? 2 : 5) & 7];
    const high = color[i < 8 ? 5 : 4] >> (i & 7) & 1;
    const low = color[i < 8 ? 7 : 6] >> (i & 7) & 1;
    const by = (low ? large : small) * (high ? -1 : 1);
    const alpha = base + table[Number(bits >> BigInt(45 - 3 * i) & 7n)] * (how >> 4);
    put(x, y, [...bases[half].map((value) => limited(value + by)), limited(alpha)]);
  }
}

function decodeEtc2({ data, width, height }) {
  const texels = new Uint8Array(width * height * 4);
  const across = Math.ceil(width / 4);
  for (let at = 0; at < data.length / 16; ++at) {
    etc2Block(data.subarray(at * 16, at * 16 + 16), (x, y, texel) => {
      const [column, row] = [(at % across) * 4 + x, Math.floor(at / across) * 4 + y];
      if (column < width && row < height) texels.set(texel, (row * width + column) * 4);
    });
  }
  return { data: texels, width, height };
}

// --- Comparison ---

// More than 60 dB is 60: such errors are far below the rounding to 8 bits.
function decibels(one, other) {
  let sum = 0;
  for (let i = 0; i < one.data.length; ++i) sum += (one.data[i] - other.data[i]) ** 2;
  return Math.min(10 * Math.log10(255 * 255 * one.data.length / sum), 60);
}

const sources = {};
for (const [name, material] of Object.entries(classes)) {
  for (const [width, height] of sizes) {
    const full = `${name}-${width}x${height}`;
    sources[full] = paint(name, width, height);
    writeFileSync(path.join(assets, `${full}.png`), png(sources[full]));
    writeFileSync(path.join(assets, `${full}.gltf`), JSON.stringify({
      asset: { version: '2.0' }, materials: [material], textures: [{ source: 0 }], images: [{ uri: `${full}.png` }],
    }));
  }
}
const converted = path.join(assets, 'converted');
execFileSync(gltfx, ['convert', assets, '-o', converted, '--images', 'ktx2'], { stdio: 'pipe' });

let failed = false;
for (const name of Object.keys(classes)) {
  const linear = ['normals', 'orm', 'grey'].includes(name);
  let row = name.padEnd(9);
  for (const [width, height] of sizes) {
    const full = `${name}-${width}x${height}`;
    const { uri } = JSON.parse(readFileSync(path.join(converted, `${full}.gltf`))).images[0];
    const ours = readFileSync(path.join(converted, uri));
    keep(`gltfx-${full}`, ours);
    if (width % 4 !== 0 || height % 4 !== 0 || width < 64) continue;
    const theirs = await encode(sources[full], { isUASTC: true, uastcLDRQualityLevel: 2, generateMipmap: false,
      isSetKTX2SRGBTransferFunc: !linear, isPerceptual: !linear });
    for (const [format, decode, most] of [['rgba32', (level) => level, 1], ['etc2', decodeEtc2, 2]]) {
      const [own, peer] = [ours, theirs].map((bytes) =>
        decibels(sources[full], decode(transcode(full, bytes, formats[format])[0])));
      row += `  ${width} ${format}: ${own.toFixed(1)} dB, peer ${peer.toFixed(1)} dB`;
      if (!(own >= peer - most)) {
        row += ' TOO LOW';
        failed = true;
      }
    }
  }
  console.log(row);
}
console.log(`${counts.files} files of gltfx, ${counts.levels} levels, ${counts.texels} texels`);
process.exit(failed ? 1 : 0);

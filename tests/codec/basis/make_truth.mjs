// SPDX-License-Identifier: Apache-2.0
// Makes KTX2 images in ETC1S and UASTC, and the texels that Binomial's transcoder decodes:
//   node make_truth.mjs MODULES FOLDER [few]
// MODULES has the npm packages ktx2-encoder, with the encoder, and three, with the transcoder. FOLDER gets
// NAME.ktx2 and, for each level, NAME.LEVEL.png in RGBA. `few` makes the small set in this folder.
import { mkdirSync } from 'node:fs';

import { loadBasis, paint, pictures, random } from './basis.mjs';

const [modules, folder, few] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const { counts, encode, keep } = await loadBasis(modules, folder);

async function make(picture, width, height, options) {
  const bytes = await encode(paint(picture, width, height), options);
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
  const bytes = await encode(paint('smoke', few ? 64 : 512, few ? 64 : 512), uastc(0, false, false));
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

// SPDX-License-Identifier: Apache-2.0
// PNG images of every color type, from pixels in RGBA with 8 bits a channel.
import { crc32, deflateSync } from 'node:zlib';

const chunk = (type, data) => {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length);
  body.copy(out, 4);
  out.writeUInt32BE(checksum(body), body.length + 4);
  return out;
};

// zlib.crc32 came with Node.js 20.15.
const table = Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? (n >>> 1) ^ 0xedb88320 : n >>> 1;
  return n >>> 0;
});
const checksum = crc32 ?? (bytes => {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = table[(crc ^ byte) & 255] ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
});

const gray = ([r, g, b]) => Math.round(0.3 * r + 0.6 * g + 0.1 * b);
const wide = value => [value, value];
const samples = {
  gray: { colorType: 0, of: p => [gray(p)] },
  grayAlpha: { colorType: 4, of: p => [gray(p), p[3]] },
  rgb: { colorType: 2, of: p => p.slice(0, 3) },
  rgba: { colorType: 6, of: p => p },
};

// Passes of the interlacing of PNG: x and y of the first pixel, and steps.
const passes = [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

// png({ size, at(x, y), kind, bits, palette, transparent, interlaced, gamma }): at() gives [r, g, b, a].
export function png({ size, at, kind = 'rgb', bits = 8, palette = false, transparent = false, interlaced = false, gamma }) {
  const colors = [];
  const index = p => {
    const key = p.join();
    if (!colors.includes(key)) colors.push(key);
    return colors.indexOf(key);
  };
  const pixel = p => (palette ? [index(p)] : bits === 16 ? samples[kind].of(p).flatMap(wide) : samples[kind].of(p));
  const rows = [];
  for (const [x0, y0, dx, dy] of interlaced ? passes : [[0, 0, 1, 1]])
    for (let y = y0; y < size[1]; y += dy) {
      const row = [0];
      for (let x = x0; x < size[0]; x += dx) row.push(...pixel(at(x, y)));
      if (row.length > 1) rows.push(Buffer.from(row));
    }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(size[0], 0);
  header.writeUInt32BE(size[1], 4);
  header.set([bits, palette ? 3 : samples[kind].colorType, 0, 0, interlaced ? 1 : 0], 8);
  const chunks = [chunk('IHDR', header)];
  if (gamma) {
    const data = Buffer.alloc(4);
    data.writeUInt32BE(gamma);
    chunks.push(chunk('gAMA', data));
  }
  const entries = colors.map(key => key.split(',').map(Number));
  if (palette) chunks.push(chunk('PLTE', Buffer.from(entries.flatMap(c => c.slice(0, 3)))));
  if (transparent) chunks.push(chunk('tRNS', Buffer.from(entries.map(c => c[3]))));
  // Level 0: the bytes depend on no version of zlib.
  chunks.push(chunk('IDAT', deflateSync(Buffer.concat(rows), { level: 0 })), chunk('IEND', Buffer.alloc(0)));
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), ...chunks]);
}

// Four quadrants of different colors, so that every orientation and filter shows.
export const quadrants = (size, alpha = [255, 255, 255, 255]) => (x, y) => {
  const quadrant = (x * 2 >= size[0] ? 1 : 0) + (y * 2 >= size[1] ? 2 : 0);
  return [...[[200, 40, 40], [40, 200, 40], [40, 40, 200], [220, 200, 60]][quadrant], alpha[quadrant]];
};

// SPDX-License-Identifier: Apache-2.0
// Zip archives, sound and hostile, written by other code than that which reads them.
import { crc32 as nodeCrc, deflateRawSync } from "node:zlib";

function crc(bytes) {
  if (nodeCrc) return nodeCrc(bytes);
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; ++bit) sum = sum & 1 ? (sum >>> 1) ^ 0xedb88320 : sum >>> 1;
  }
  return ~sum >>> 0;
}

/**
 * Files as [{path, bytes, ...lies}]. Lies: `method`, `flags`, `crc`, `size`, `attributes`, `maker`, and
 * `same`: the entry refers to the content of the first one.
 */
export function archive(files, { comment = "", entries = files.length, cut = 0 } = {}) {
  const local = [];
  const list = [];
  let at = 0;
  let first = 0;
  for (const file of files) {
    const name = Buffer.from(file.path);
    const method = file.method ?? 8;
    const packed = method === 8 ? deflateRawSync(file.bytes) : Buffer.from(file.bytes);
    const common = Buffer.alloc(26);
    common.writeUInt16LE(20, 0);
    common.writeUInt16LE(file.flags ?? 0x800, 2);
    common.writeUInt16LE(method, 4);
    common.writeUInt32LE(file.crc ?? crc(file.bytes), 10);
    common.writeUInt32LE(packed.length, 14);
    common.writeUInt32LE(file.size ?? file.bytes.length, 18);
    common.writeUInt16LE(name.length, 22);
    const entry = Buffer.alloc(46);
    entry.writeUInt32LE(0x02014b50, 0);
    entry.writeUInt8(file.maker ?? 3, 5);
    common.copy(entry, 6);
    entry.writeUInt32LE(file.attributes ?? 0, 38);
    entry.writeUInt32LE(file.same ? first : at, 42);
    list.push(entry, name);
    if (file.same) continue;
    if (list.length === 2) first = at;
    local.push(Buffer.from("PK\x03\x04", "latin1"), common, name, packed);
    at += 30 + name.length + packed.length;
  }
  const listed = Buffer.concat(list);
  const end = Buffer.alloc(22);
  end.writeUInt32LE(0x06054b50, 0);
  end.writeUInt16LE(entries, 8);
  end.writeUInt16LE(entries, 10);
  end.writeUInt32LE(listed.length, 12);
  end.writeUInt32LE(at, 16);
  end.writeUInt16LE(comment.length, 20);
  const all = Buffer.concat([...local, listed, end, Buffer.from(comment)]);
  return all.subarray(0, all.length - cut);
}

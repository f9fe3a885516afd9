// SPDX-License-Identifier: Apache-2.0
// Archives. Reading trusts no field of an archive; writing stores without compression, and the same files give the same
// bytes.

const END = 0x06054b50;
const ENTRY = 0x02014b50;
const LOCAL = 0x04034b50;
const END_SIZE = 22;
const LONGEST_COMMENT = 0xffff;
const LARGEST_LIST = 64 << 20;
const MOST_UNPACKED = 4 * 2 ** 30;
const MOST_RATIO = 200; // of a whole archive, if it unpacks to more than:
const RATIO_MATTERS = 256 << 20;
const MOST_DEFLATE = 1032; // maximum bytes from one byte of a deflate stream
const DAY = 0x21; // 1 January 1980, the first date of the format

const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let rest = byte;
  for (let bit = 0; bit < 8; ++bit) rest = rest & 1 ? (rest >>> 1) ^ 0xedb88320 : rest >>> 1;
  return rest;
});

export function crc32(bytes) {
  let sum = 0xffffffff;
  for (let at = 0; at < bytes.length; ++at) sum = CRC_TABLE[(sum ^ bytes[at]) & 255] ^ (sum >>> 8);
  return (sum ^ 0xffffffff) >>> 0;
}

async function view(blob, from, to) {
  return new DataView(await blob.slice(from, to).arrayBuffer());
}

async function findEnd(blob) {
  const from = Math.max(0, blob.size - END_SIZE - LONGEST_COMMENT);
  const tail = await view(blob, from, blob.size);
  for (let at = tail.byteLength - END_SIZE; at >= 0; --at) {
    const whole =
      tail.getUint32(at, true) === END && at + END_SIZE + tail.getUint16(at + 20, true) === tail.byteLength;
    if (!whole) continue;
    const entries = tail.getUint16(at + 10, true);
    const size = tail.getUint32(at + 12, true);
    const begin = tail.getUint32(at + 16, true);
    if (entries === 0xffff || begin === 0xffffffff) throw new Error("it is a ZIP64 archive; unpack it first");
    if (begin + size > from + at || size > LARGEST_LIST) throw new Error("its list of files is broken");
    return { entries, begin, size };
  }
  throw new Error("it is not a whole zip archive");
}

/** Some programs write the separators of Windows, or "./" before a path. */
function plainPath(path) {
  return path.replaceAll("\\", "/").replace(/(^|\/)(\.\/)+/g, "$1");
}

function readEntry(list, at) {
  if (at + 46 > list.byteLength || list.getUint32(at, true) !== ENTRY)
    throw new Error("its list of files is broken");
  const nameSize = list.getUint16(at + 28, true);
  const next = at + 46 + nameSize + list.getUint16(at + 30, true) + list.getUint16(at + 32, true);
  if (next > list.byteLength) throw new Error("its list of files is broken");
  return {
    path: plainPath(new TextDecoder().decode(new Uint8Array(list.buffer, at + 46, nameSize))),
    nameSize,
    encrypted: (list.getUint16(at + 8, true) & 1) !== 0,
    method: list.getUint16(at + 10, true),
    crc: list.getUint32(at + 16, true),
    packed: list.getUint32(at + 20, true),
    size: list.getUint32(at + 24, true),
    isLink: list.getUint8(at + 5) === 3 && (list.getUint16(at + 40, true) & 0xf000) === 0xa000,
    begin: list.getUint32(at + 42, true),
    next,
  };
}

/** Throws for an archive that unpacks to far more than its size, or lists the same bytes several times. */
function refuseBombs(entries, blob, end) {
  const total = entries.reduce((sum, entry) => sum + entry.size, 0);
  if (total > MOST_UNPACKED) throw new Error("it unpacks to more than 4 GB");
  if (total > RATIO_MATTERS && total > MOST_RATIO * blob.size)
    throw new Error("it unpacks to far more than it is");
  const inOrder = entries.slice().sort((a, b) => a.begin - b.begin);
  inOrder.forEach((entry, i) => {
    const room = (i + 1 < inOrder.length ? inOrder[i + 1].begin : end.begin) - entry.begin;
    if (30 + entry.nameSize + entry.packed > room) throw new Error("files in it overlap");
  });
}

function problemOf(entry) {
  if (entry.encrypted) return "it is encrypted";
  if (entry.isLink) return "it is a symbolic link";
  if (entry.method !== 0 && entry.method !== 8) return "it is packed by a method other than deflate";
  if (entry.method === 0 ? entry.size !== entry.packed : entry.size > MOST_DEFLATE * entry.packed + 64) {
    return "its size is wrong";
  }
  return "";
}

async function inflate(packed, size) {
  const bytes = new Uint8Array(size);
  const reader = packed.stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader();
  let used = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    if (used + value.length > size) {
      await reader.cancel();
      throw new Error("it unpacks to more than its archive says");
    }
    bytes.set(value, used);
    used += value.length;
  }
  if (used !== size) throw new Error("it unpacks to less than its archive says");
  return bytes;
}

async function readContent(blob, entry) {
  const head = await view(blob, entry.begin, entry.begin + 30);
  if (head.byteLength < 30 || head.getUint32(0, true) !== LOCAL) throw new Error("its archive is broken");
  const from = entry.begin + 30 + head.getUint16(26, true) + head.getUint16(28, true);
  const packed = blob.slice(from, from + entry.packed);
  if (packed.size !== entry.packed) throw new Error("its archive is cut off");
  const bytes =
    entry.method === 0 ? new Uint8Array(await packed.arrayBuffer()) : await inflate(packed, entry.size);
  if (crc32(bytes) !== entry.crc) throw new Error("its checksum is wrong");
  return bytes;
}

/**
 * The files of an archive, none of them unpacked yet: [{path, size, problem, read()}]. Throws if the
 * whole archive must not be read.
 */
export async function readZip(blob) {
  const end = await findEnd(blob);
  const list = await view(blob, end.begin, end.begin + end.size);
  const entries = [];
  for (let at = 0; entries.length < end.entries;) {
    const entry = readEntry(list, at);
    entries.push(entry);
    at = entry.next;
  }
  refuseBombs(entries, blob, end);
  return entries
    .filter((entry) => entry.path !== "" && !entry.path.endsWith("/"))
    .map((entry) => ({
      path: entry.path,
      size: entry.size,
      problem: problemOf(entry),
      read: () => readContent(blob, entry),
    }));
}

function head(signature, size, name, bytes) {
  const all = new Uint8Array(size + name.length);
  const fields = new DataView(all.buffer);
  const at = signature === ENTRY ? 6 : 4; // the list has one more field before it
  fields.setUint32(0, signature, true);
  if (signature === ENTRY) fields.setUint16(4, 20, true);
  fields.setUint16(at, 20, true);
  fields.setUint16(at + 2, 0x800, true); // names are UTF-8
  fields.setUint16(at + 8, DAY, true);
  fields.setUint32(at + 10, crc32(bytes), true);
  fields.setUint32(at + 14, bytes.length, true);
  fields.setUint32(at + 18, bytes.length, true);
  fields.setUint16(at + 22, name.length, true);
  all.set(name, size);
  return all;
}

/** An archive of files, [[path, bytes]], as a Blob. */
export function writeZip(files) {
  const parts = [];
  const list = [];
  let begin = 0;
  let listSize = 0;
  for (const [path, bytes] of files) {
    const name = new TextEncoder().encode(path);
    const local = head(LOCAL, 30, name, bytes);
    const entry = head(ENTRY, 46, name, bytes);
    new DataView(entry.buffer).setUint32(42, begin, true);
    parts.push(local, bytes);
    list.push(entry);
    begin += local.length + bytes.length;
    listSize += entry.length;
  }
  if (begin + listSize > 0xfffffffe || list.length >= 0xffff) throw new Error("the archive is too large");
  const end = new DataView(new ArrayBuffer(END_SIZE));
  end.setUint32(0, END, true);
  end.setUint16(8, list.length, true);
  end.setUint16(10, list.length, true);
  end.setUint32(12, listSize, true);
  end.setUint32(16, begin, true);
  return new Blob([...parts, ...list, end.buffer], { type: "application/zip" });
}

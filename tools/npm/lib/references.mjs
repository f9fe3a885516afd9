// SPDX-License-Identifier: Apache-2.0
// Paths in members named "uri", wherever they stand and whether or not the text around them is valid.
const member = Buffer.from('"uri"');
const quote = 0x22;
const backslash = 0x5c;

function endOfString(bytes, begin) {
  for (let at = bytes.indexOf(quote, begin); at >= 0; at = bytes.indexOf(quote, at + 1)) {
    let slashes = 0;
    while (bytes[at - 1 - slashes] === backslash) ++slashes;
    if (slashes % 2 === 0) return at;
  }
  return -1;
}

function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Relative paths that an asset refers to: as they are written, and with escapes decoded. */
export function referencesIn(asset) {
  const bytes = Buffer.from(asset.buffer, asset.byteOffset, asset.byteLength);
  const found = new Set();
  for (let at = bytes.indexOf(member); at >= 0; at = bytes.indexOf(member, at)) {
    at += member.length;
    const separator = /^\s*:\s*"/.exec(bytes.toString("latin1", at, at + 64));
    if (separator === null) continue;
    const begin = at + separator[0].length;
    const end = endOfString(bytes, begin);
    if (end < 0) break;
    at = end + 1;
    if (/^[a-z][a-z0-9+.-]*:/i.test(bytes.toString("latin1", begin, begin + 16))) continue;
    try {
      const uri = JSON.parse(bytes.toString("utf8", begin - 1, end + 1));
      for (const path of [uri, decoded(uri.replace(/[?#][^]*$/, ""))]) {
        if (path !== "" && !path.includes("\0")) found.add(path);
      }
    } catch {
      // no string of JSON
    }
  }
  return found;
}

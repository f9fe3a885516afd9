// SPDX-License-Identifier: Apache-2.0
// The objects of an engine as a text that is equal for equal objects.
import { createHash } from 'node:crypto';

const round = x => (Number.isFinite(x) ? Math.round(x * 1e5) / 1e5 + 0 : String(x));

// Lines for everything that can be reached from the roots. skip(key, value, owner) leaves members out.
export function dump(roots, skip = () => false) {
  const numbers = new Map();  // an object: the number of its first visit
  const queue = [];
  const lines = [];
  const say = (value, key) => {
    if (typeof value === 'number') return round(value);
    if (value === null || typeof value !== 'object') return typeof value === 'function' || typeof value === 'symbol' ? 'function' : JSON.stringify(value) ?? 'undefined';
    if (ArrayBuffer.isView(value) || value instanceof ArrayBuffer) return bytes(value);
    if (!numbers.has(value)) {
      numbers.set(value, numbers.size);
      queue.push(value);
    }
    return `#${numbers.get(value)}`;
  };
  const members = value => {
    if (value instanceof Map) return [...value].map(([k, v]) => [typeof k === 'object' ? say(k) : String(k), v]);
    if (value instanceof Set) return [...value].map((v, i) => [i, v]);
    return Object.entries(Object.getOwnPropertyDescriptors(value)).filter(([, d]) => d.enumerable && 'value' in d).map(([k, d]) => [k, d.value]);
  };
  say(roots);
  while (queue.length > 0) {
    const value = queue.shift();
    const parts = members(value).filter(([key, member]) => typeof member !== 'function' && member !== undefined && !skip(key, member, value))
      .sort(([a], [b]) => (Array.isArray(value) ? 0 : a < b ? -1 : 1));
    lines.push(`${numbers.get(value)} ${value.constructor?.name ?? ''} ${parts.map(([key, member]) => `${key}=${say(member, key)}`).join(' ')}`);
    if (lines.length > 200000) throw new Error('harness: the dump does not end');
  }
  return lines.join('\n');
}

function bytes(value) {
  const hash = createHash('sha256');
  if (value instanceof ArrayBuffer || !('length' in value) || value instanceof Uint8Array && value.length > 4096) return `bytes ${value.byteLength} ${hash.update(new Uint8Array(value.buffer ?? value)).digest('hex').slice(0, 12)}`;
  return `${value.constructor.name} ${value.length} ${hash.update(Array.from(value, round).join()).digest('hex').slice(0, 12)}`;
}

// The corners of primitives, which do not depend on indices or modes: { corners, positions, lines, points }.
// parts: [{ mode (of glTF), index: array or null, attributes: { name: (i) => [numbers] }, matrix: (position) => position }].
export function corners(parts) {
  const facts = { corners: [], positions: [], lines: [], points: [] };
  for (const { mode, index, count, attributes, place } of parts) {
    const order = index ?? Array.from({ length: count }, (_, i) => i);
    const at = i => {
      const all = Object.keys(attributes).sort().map(name => `${name} ${(name === 'POSITION' ? place : v => v)(attributes[name](i)).map(v => (Math.round(v * 100) / 100 + 0).toFixed(2)).join(' ')}`);
      return [all.join(' | '), place(attributes.POSITION(i)).map(v => (Math.round(v * 100) / 100 + 0).toFixed(2)).join(' ')];
    };
    for (const face of faces(mode, order)) {
      const both = face.map(at);
      const kind = face.length === 3 ? 'corners' : face.length === 2 ? 'lines' : 'points';
      const turn = list => (face.length === 3 ? least([list, [list[1], list[2], list[0]], [list[2], list[0], list[1]]].map(x => x.join(' / '))) : [...list].sort().join(' / '));
      facts.corners.push(turn(both.map(x => x[0])));
      facts.positions.push(turn(both.map(x => x[1])));
      if (kind !== 'corners') facts[kind].push(turn(both.map(x => x[1])));
    }
  }
  for (const list of Object.values(facts)) list.sort();
  return facts;
}
const least = texts => texts.sort()[0];

function faces(mode, order) {
  const n = order.length;
  const all = (length, pick) => Array.from({ length: Math.max(0, length) }, (_, i) => pick(i));
  switch (mode) {
    case 0: return order.map(i => [i]);
    case 1: return all(Math.floor(n / 2), i => [order[2 * i], order[2 * i + 1]]);
    case 2: return all(n, i => [order[i], order[(i + 1) % n]]);
    case 3: return all(n - 1, i => [order[i], order[i + 1]]);
    case 5: return all(n - 2, i => (i % 2 ? [order[i + 1], order[i], order[i + 2]] : [order[i], order[i + 1], order[i + 2]]));
    case 6: return all(n - 2, i => [order[0], order[i + 1], order[i + 2]]);
    default: return all(Math.floor(n / 3), i => [order[3 * i], order[3 * i + 1], order[3 * i + 2]]);
  }
}

export const hash = bytes => createHash('sha256').update(bytes).digest('hex').slice(0, 12);

// A failure during the inspection of the objects is not a failure of the engine.
export function described(describe) {
  try {
    return describe();
  } catch (error) {
    throw new Error(`harness: ${error.stack}`);
  }
}

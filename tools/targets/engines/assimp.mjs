// SPDX-License-Identifier: Apache-2.0
// Assimp: the output of its program for an asset.
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { corners, described } from './dump.mjs';
import { withFiles } from './process.mjs';

export async function open() {
  return { load: (files, main) => withFiles(files, main, (path, folder) => {
    // The binary dump has everything, after 512 bytes with the time and the command. JSON is not written for nodes with
    // metadata.
    const all = written(['dump', path, `${folder}/assimp.bin`, '-b']);
    if (all === undefined) throw new Error('harness: assimp writes nothing');
    const text = all.subarray(512).toString('latin1');
    const json = written(['export', path, `${folder}/assimp.json`, '-fassjson'])?.toString();
    // It has six digits of a number, too few for a million.
    const exact = json && !/\de\+0[6-9]/.test(json);
    return described(() => ({ dump: text, facts: exact ? facts(JSON.parse(json.replace(/\b-?(nan|inf)\b/g, 'null'))) : {} }));
  }) };
}

function written(args) {
  const run = spawnSync('assimp', args, { encoding: 'utf8', timeout: 9000 });
  if (run.error) throw new Error(`harness: ${run.error.message}`);
  if (/Failed to load file/.test(run.stdout)) throw new Error(run.stdout.split('\n').slice(-3).join(' '));
  return existsSync(args[2]) ? readFileSync(args[2]) : undefined;
}

const chunks = (list, width) => Array.from({ length: Math.floor((list?.length ?? 0) / width) }, (_, i) => list.slice(i * width, (i + 1) * width));
const product = (a, b) => Array.from({ length: 16 }, (_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[(i & ~3) + k] * b[k * 4 + (i & 3)], 0));
const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function facts({ rootnode, meshes = [], animations = [], lights = [] }) {
  const parts = [];
  const found = { names: [], nodes: [], tracks: [], skin: [], animations: animations.map(it => it.name), lights: lights.length };
  const worlds = new Map();  // by name: Assimp finds the first node that has it
  const visit = (node, above) => {
    const world = product(above, node.transformation ?? identity);
    if (!worlds.has(node.name)) worlds.set(node.name, { world, number: found.names.length });
    found.names.push(node.name);
    found.nodes.push(`${node.name} ${world.map(v => v.toFixed(3)).join(' ')}`);
    const place = v => [0, 1, 2].map(r => world[r * 4] * v[0] + world[r * 4 + 1] * v[1] + world[r * 4 + 2] * v[2] + world[r * 4 + 3]);
    for (const index of node.meshes ?? []) parts.push(...primitives(meshes[index], place));
    for (const child of node.children ?? []) visit(child, world);
  };
  visit(rootnode, identity);
  for (const mesh of meshes) found.skin.push(...skinned(mesh, name => worlds.get(name)?.world ?? identity));
  found.moved = animations.flatMap(it => (it.channels ?? []).map(channel => worlds.get(channel.name)?.number ?? -1));
  for (const it of animations)
    for (const channel of it.channels ?? [])
      for (const [kind, keys] of Object.entries(channel).filter(([key]) => key.endsWith('keys'))) found.tracks.push(`${kind} ${keys.map(([time, value]) => `${Number(time).toFixed(2)} ${[value].flat().map(v => Number(v).toFixed(2))}`).join('; ')}`);
  return { ...corners(parts), ...found };
}

// Where the vertices of a mesh with bones are.
function skinned({ vertices, bones = [] }, worldOf) {
  if (bones.length === 0) return [];
  const sums = chunks(vertices, 3).map(() => [0, 0, 0]);
  for (const { name, offsetmatrix, weights = [] } of bones) {
    const m = product(worldOf(name), offsetmatrix);
    for (const [vertex, weight] of weights) {
      const v = [...vertices.slice(vertex * 3, vertex * 3 + 3), 1];
      [0, 1, 2].forEach(r => { sums[vertex][r] += weight * [0, 1, 2, 3].reduce((sum, c) => sum + m[r * 4 + c] * v[c], 0); });
    }
  }
  return sums.map(sum => sum.map(x => (Math.round(x * 100) / 100 + 0).toFixed(2)).join(' '));
}

// Faces of one, two and three corners.
function primitives(mesh, place) {
  const lists = { POSITION: chunks(mesh.vertices, 3), NORMAL: chunks(mesh.normals, 3) };
  (mesh.texturecoords ?? []).slice(0, 2).forEach((list, i) => { lists[`TEXCOORD_${i}`] = chunks(list, mesh.numuvcomponents?.[i] ?? 2); });
  if (mesh.colors?.[0]) lists.COLOR_0 = chunks(mesh.colors[0], 4);
  const attributes = Object.fromEntries(Object.entries(lists).filter(([, list]) => list.length > 0).map(([name, list]) => [name, i => list[i]]));
  return [[1, 0], [2, 1], [3, 4]].map(([size, mode]) => ({ mode, index: mesh.faces.filter(face => face.length === size).flat(), attributes, place })).filter(it => it.index.length > 0);
}

// SPDX-License-Identifier: Apache-2.0
// A loader that forgets one extension changes the row of that extension in its target file, and nothing else.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));

// The line of the loader that registers an extension is taken out of a copy of it.
const plugin = name => new RegExp(`this\\.register\\( function \\( parser \\) \\{\\s*return new ${name}\\( parser \\);\\s*\\} \\);`);
const three = { target: 'three', copied: ['three/package.json', 'three/build', 'three/examples/jsm'], linked: [] };
const babylon = { target: 'babylon', copied: ['@babylonjs/loaders'], linked: ['@babylonjs/core'] };
const babylonFile = name => `@babylonjs/loaders/glTF/2.0/Extensions/${name}.js`;
const mutations = [
  { extension: 'KHR_materials_sheen', ...three, file: 'three/examples/jsm/loaders/GLTFLoader.js', without: plugin('GLTFMaterialsSheenExtension') },
  { extension: 'KHR_materials_transmission', ...three, file: 'three/examples/jsm/loaders/GLTFLoader.js', without: plugin('GLTFMaterialsTransmissionExtension') },
  { extension: 'KHR_materials_sheen', ...babylon, file: babylonFile('KHR_materials_sheen'), without: 'RegisterKHR_materials_sheen();' },
  { extension: 'MSFT_lod', ...babylon, file: babylonFile('MSFT_lod'), without: 'RegisterMSFT_lod();' },
];

// The names of the rows that differ when the newest version is measured with the changed loader.
function changedRows({ target, copied, linked, file, without }) {
  const committed = readFileSync(`${root}schema/targets/${target}.json`, 'utf8');
  const version = JSON.parse(committed).versions.at(-1).version;
  const folder = mkdtempSync(`${tmpdir()}/gltfx-mutation-`);
  try {
    const [from, to] = [`${root}build/targets/npm`, folder].map(place => `${place}/${target}-${version}/node_modules`);
    for (const part of copied) cpSync(`${from}/${part}`, `${to}/${part}`, { recursive: true });
    for (const part of linked) {
      mkdirSync(dirname(`${to}/${part}`), { recursive: true });
      symlinkSync(`${from}/${part}`, `${to}/${part}`);
    }
    const before = readFileSync(`${to}/${file}`, 'utf8');
    const after = before.replace(without, '');
    assert.notEqual(after, before);
    writeFileSync(`${to}/${file}`, after);
    const run = spawnSync(`${root}tools/targets/measure`, ['--packages', folder, '--out', folder, `${target}@${version}`], { encoding: 'utf8' });
    assert.equal(run.status, 0, run.stderr);
    const rows = text => text.split('\n').map(row => row.replace(/,$/, ''));
    const old = rows(committed);
    return rows(readFileSync(`${folder}/${target}.json`, 'utf8')).filter((row, i) => row !== old[i]).map(row => row.trim().split('"')[1]);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

for (const mutation of mutations)
  test(`${mutation.target} without ${mutation.extension}`, () => assert.deepEqual(changedRows(mutation), [mutation.extension]));

// SPDX-License-Identifier: Apache-2.0
// A loader that forgets one extension changes the rows of that extension in its target file, and nothing else.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));
const committed = readFileSync(`${root}schema/targets/three.json`, 'utf8');
const version = JSON.parse(committed).versions.at(-1).version;
const loader = 'node_modules/three/examples/jsm/loaders/GLTFLoader.js';

// The target file of three.js, measured in a copy whose loader was changed.
function measuredWith(change) {
  const folder = mkdtempSync(`${tmpdir()}/gltfx-mutation-`);
  try {
    const copy = `${folder}/three-${version}`;
    for (const part of ['package.json', 'build', 'examples/jsm'])
      cpSync(`${root}build/targets/npm/three-${version}/node_modules/three/${part}`, `${copy}/node_modules/three/${part}`, { recursive: true });
    const before = readFileSync(`${copy}/${loader}`, 'utf8');
    const after = change(before);
    assert.notEqual(after, before);
    writeFileSync(`${copy}/${loader}`, after);
    const run = spawnSync(`${root}tools/targets/measure`, ['--packages', folder, '--out', folder, `three@${version}`], { encoding: 'utf8' });
    assert.equal(run.status, 0, run.stderr);
    return readFileSync(`${folder}/three.json`, 'utf8');
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const rows = text => text.split('\n').map(row => row.replace(/,$/, ''));
const changed = text => rows(text).filter((row, i) => row !== rows(committed)[i]).map(row => row.trim().split('"')[1]);
const forget = name => text => text.replace(new RegExp(`this\\.register\\( function \\( parser \\) \\{\\s*return new ${name}\\( parser \\);\\s*\\} \\);`), '');

for (const [plugin, extension] of [['GLTFMaterialsSheenExtension', 'KHR_materials_sheen'], ['GLTFMaterialsTransmissionExtension', 'KHR_materials_transmission']])
  test(`${version} without ${extension}`, () => assert.deepEqual(changed(measuredWith(forget(plugin))), [extension]));

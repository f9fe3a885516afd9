// SPDX-License-Identifier: Apache-2.0
// Probes are valid assets of features in the list, enough of them; each target has a file as `measure` writes it.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { outcomesOf, targetText } from '../../tools/targets/target_file.mjs';

const root = fileURLToPath(new URL('../../', import.meta.url));
const { features } = JSON.parse(readFileSync(`${root}schema/targets/features.json`, 'utf8'));
const targets = JSON.parse(readFileSync(`${root}tools/targets/targets.json`, 'utf8'));
const files = readdirSync(`${root}schema/targets`).filter(name => name.endsWith('.json') && name !== 'features.json');

test('probes and twins are valid', () => {
  const folder = mkdtempSync(`${tmpdir()}/gltfx-probes-`);
  try {
    assert.equal(spawnSync(process.execPath, [`${root}tools/targets/probes/write.mjs`, folder]).status, 0);
    const list = JSON.parse(readFileSync(`${folder}/probes.json`, 'utf8'));
    assert.ok(list.length >= 110);
    for (const { feature } of list) assert.ok(features[feature], feature);
    const run = spawnSync(process.env.GLTFX ?? `${root}build/dev/bin/gltfx`, ['validate', '--format', 'json', folder], { encoding: 'utf8', maxBuffer: 1 << 28 });
    const errors = JSON.parse(run.stdout).files.flatMap(file => (file.findings ?? []).filter(it => it.severity === 'error').map(it => `${file.path.slice(folder.length + 1)} ${it.code}`));
    // Each of these probes is about what is wrong with it.
    assert.deepEqual(errors, ['KHR_draco_mesh_compression/requiredWithFallback/asset/asset.gltf DRACO_COPY_UNREAD', 'image.jpeg-cmyk/used/asset/asset.gltf IMAGE_DATA_INVALID',
      'image.png-16-bit/used/asset/asset.gltf TEXTURE_NOT_8_BIT']);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('each target has a file in the form that measure writes, of versions in the list', () => {
  assert.deepEqual(files.map(name => name.replace('.json', '')).sort(), Object.keys(targets).sort());
  let versions = 0;
  for (const name of files) {
    const text = readFileSync(`${root}schema/targets/${name}`, 'utf8');
    const target = targets[name.replace('.json', '')];
    const outcomes = outcomesOf(JSON.parse(text));
    assert.equal(text, targetText(name.replace('.json', ''), target, outcomes), name);
    for (const version of outcomes.keys()) assert.ok(target.versions.includes(version), `${name} ${version}`);
    for (const feature of Object.keys(JSON.parse(text).features)) assert.ok(features[feature], `${name} ${feature}`);
    versions += outcomes.size;
  }
  assert.ok(versions >= 40);
});

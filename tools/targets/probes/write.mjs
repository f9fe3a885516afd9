#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// Writes all probes and their twins: write FOLDER. probes.json says what to compare.
import { mkdirSync, writeFileSync } from 'node:fs';
import { dirname } from 'node:path';

const [folder] = process.argv.slice(2);
if (!folder) {
  process.stderr.write('usage: write FOLDER\n');
  process.exit(2);
}
const { probes } = await import('./index.mjs');
const list = [];
for (const probe of probes()) {
  const place = `${probe.feature}/${probe.mode}`;
  const entry = { feature: probe.feature, mode: probe.mode, ...(probe.same && { same: true }) };
  for (const part of ['asset', 'twin']) {
    const files = probe[part].written();
    for (const [name, bytes] of files) {
      const path = `${folder}/${place}/${part}/${name}`;
      mkdirSync(dirname(path), { recursive: true });
      writeFileSync(path, bytes);
    }
    entry[part === 'asset' ? 'probe' : 'twin'] = `${place}/${part}/${files[0][0]}`;
  }
  list.push(entry);
}
writeFileSync(`${folder}/probes.json`, `${JSON.stringify(list, null, 1)}\n`);

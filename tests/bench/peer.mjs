// SPDX-License-Identifier: Apache-2.0
// The peer: the Khronos validator's npm package over a file or every .gltf of a folder, one after
// the other in one process, with the resources they name.
//
//   node peer.mjs FOLDER_OF_NODE_MODULES PATH
import { createRequire } from 'node:module';
import { readdirSync, readFileSync, statSync } from 'node:fs';
import { dirname, extname, join, resolve } from 'node:path';

const [modules, target] = process.argv.slice(2);
const validator = createRequire(resolve(modules, 'package.json'))('gltf-validator');

const files = statSync(target).isDirectory()
  ? readdirSync(target).filter((name) => ['.gltf', '.glb'].includes(extname(name)))
      .sort().map((name) => join(target, name))
  : [target];

let issues = 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    format: extname(file).slice(1),
    maxIssues: 0,
    externalResourceFunction: async (uri) =>
      new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))),
  });
  issues += report.issues.messages.length;
}
console.log(`${files.length} files, ${issues} issues`);

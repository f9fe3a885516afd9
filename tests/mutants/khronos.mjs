// SPDX-License-Identifier: Apache-2.0
// Validates assets with npm's gltf-validator, one after the other: a path a line in, for each a line of JSON
// out, codes with the number of their findings.
//
//   node khronos.mjs FOLDER_OF_NODE_MODULES
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { dirname, extname, resolve } from "node:path";
import { createInterface } from "node:readline";

const validator = createRequire(resolve(process.argv[2], "..", "user.cjs"))("gltf-validator");

async function codesOf(path) {
  const options = {
    uri: "asset",
    format: extname(path).slice(1),
    maxIssues: 0,
    writeTimestamp: false,
    externalResourceFunction: async (uri) =>
      new Uint8Array(readFileSync(resolve(dirname(path), decodeURIComponent(uri)))),
  };
  const report = await validator.validateBytes(new Uint8Array(readFileSync(path)), options);
  const codes = {};
  for (const { code } of report.issues.messages) codes[code] = (codes[code] ?? 0) + 1;
  return codes;
}

for await (const path of createInterface({ input: process.stdin })) {
  const codes = await codesOf(path).catch((error) => ({ "": String(error) }));
  process.stdout.write(`${JSON.stringify(codes)}\n`);
}

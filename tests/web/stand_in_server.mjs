// SPDX-License-Identifier: Apache-2.0
// Runs the native program for stand_in.js, each time in a folder of its own.
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";

function run(program, { args, files }) {
  const folder = mkdtempSync(join(tmpdir(), "gltfx_stand_in_"));
  try {
    const before = new Map(files);
    for (const [path, text] of files) {
      mkdirSync(dirname(join(folder, path)), { recursive: true });
      writeFileSync(join(folder, path), text, "base64");
    }
    const done = spawnSync(program, args, { cwd: folder, maxBuffer: 2 ** 30 });
    const changed = readdirSync(folder, { recursive: true, withFileTypes: true })
      .filter((entry) => entry.isFile())
      .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
      .map((path) => [path.slice(folder.length + 1), readFileSync(path, "base64")])
      .filter(([path, text]) => before.get(path) !== text);
    return { code: done.status, stdout: done.stdout.toString("base64"), stderr: done.stderr.toString(), files: changed };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** A server on a free port of this machine. */
export async function startStandIn(program) {
  const server = createServer(async (request, response) => {
    const parts = [];
    for await (const part of request) parts.push(part);
    response.setHeader("Access-Control-Allow-Origin", "*");
    response.end(JSON.stringify(run(program, JSON.parse(Buffer.concat(parts).toString()))));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return server;
}

#!/usr/bin/env node
// SPDX-License-Identifier: Apache-2.0
// The command line: the native program if its package is installed, else the engine on the files that the command line
// names.
import { spawnSync } from "node:child_process";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { runWithEngine } from "../lib/command_line.mjs";

function nativeProgram() {
  const name = `@gltfx/${process.platform}-${process.arch}/package.json`;
  try {
    return join(dirname(createRequire(import.meta.url).resolve(name)), "bin", "gltfx");
  } catch {
    return null; // an optional dependency
  }
}

const args = process.argv.slice(2);
const program = nativeProgram();
if (program === null) {
  process.exitCode = await runWithEngine(args);
} else {
  const done = spawnSync(program, args, { stdio: "inherit" });
  if (done.error) {
    process.stderr.write(`gltfx: ${program}: ${done.error.message}\n`);
    process.exitCode = 4;
  } else if (done.signal) {
    process.kill(process.pid, done.signal);
  } else {
    process.exitCode = done.status;
  }
}

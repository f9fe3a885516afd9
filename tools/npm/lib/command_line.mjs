// SPDX-License-Identifier: Apache-2.0
// Runs a command line with the engine on the files of this machine.
import { readSync } from "node:fs";
import { attachHostFiles } from "./host_files.mjs";
import { virtualPath, virtualWord } from "./paths.mjs";
import { getEngine } from "../wasm/engine_node.mjs";

function writeOut(stream, bytes) {
  return new Promise((done) => {
    stream.on("error", () => done()); // the reader has closed
    stream.write(bytes, () => done());
  });
}

// Waits for data of a non-blocking pipe.
function readInput(chunk) {
  for (;;) {
    try {
      return readSync(0, chunk);
    } catch (error) {
      if (error.code === "EOF") return 0; // on Windows
      if (error.code !== "EAGAIN") throw error;
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 10);
    }
  }
}

/** A function that gives the next byte of standard input; null: its end. */
function standardInput() {
  const chunk = new Uint8Array(1 << 16);
  let at = 0;
  let end = 0;
  return () => {
    if (at === end) {
      at = 0;
      end = readInput(chunk);
    }
    return end === 0 ? null : chunk[at++];
  };
}

/** Returns the exit code. */
export async function runWithEngine(args) {
  const cwd = process.cwd();
  try {
    const engine = await getEngine();
    const words = args.map((word) => virtualWord(word, cwd));
    const options = { cwd: virtualPath(cwd), nextByte: standardInput() };
    const done = await engine.runOn(attachHostFiles, words, options);
    await writeOut(process.stdout, done.stdout);
    await writeOut(process.stderr, done.stderr);
    return done.code;
  } catch (error) {
    await writeOut(process.stderr, `gltfx: ${error.message}\n`);
    return 4;
  }
}

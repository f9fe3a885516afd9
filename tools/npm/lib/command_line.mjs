// SPDX-License-Identifier: Apache-2.0
// Runs a command line with the engine over the real file system: what it names is read, what it writes is
// written.
import { chmodSync, mkdirSync, readFileSync, renameSync, rmSync, statSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { collectFiles, realPath, virtualPath, virtualWord } from "./command_files.mjs";
import { getEngine } from "../wasm/engine_node.mjs";

// Whole or not at all; the mode of a file that is replaced is kept.
function writeWhole(path, bytes) {
  const part = `${path}.${process.pid}.part`;
  try {
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(part, bytes);
    const old = statSync(path, { throwIfNoEntry: false });
    if (old) chmodSync(part, old.mode);
    renameSync(part, path);
  } catch (error) {
    rmSync(part, { force: true });
    throw error;
  }
}

function writeOut(stream, bytes) {
  return new Promise((done) => {
    stream.on("error", () => done()); // a reader that went away
    stream.write(bytes, () => done());
  });
}

/** Gives the exit code. */
export async function runWithEngine(args) {
  const cwd = process.cwd();
  try {
    const engine = await getEngine();
    const stdin = args.includes("-") ? readFileSync(0) : undefined;
    const files = collectFiles(args, cwd, stdin);
    const words = args.map((word) => virtualWord(word, cwd));
    const done = await engine.run(words, files, { cwd: virtualPath(cwd), stdin });
    await writeOut(process.stdout, done.stdout);
    await writeOut(process.stderr, done.stderr);
    for (const [path, bytes] of done.files) writeWhole(realPath(path, cwd), bytes);
    return done.code;
  } catch (error) {
    await writeOut(process.stderr, `gltfx: ${error.message}\n`);
    return 4;
  }
}

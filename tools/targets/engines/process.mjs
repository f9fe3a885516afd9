// SPDX-License-Identifier: Apache-2.0
// Engines that are separate programs: assets become files, and a running program answers with a line of JSON for each
// path: ANSWER, the path, a tab, and { dump, facts } or { refused }. A line LOADED before it says that the engine has
// loaded the asset: later failures are those of the harness.
import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname } from 'node:path';
import { createInterface } from 'node:readline';
import { corners } from './dump.mjs';

// Runs use(path) with the files of an asset in a temporary folder below another one.
export async function withFiles(files, main, use, above = tmpdir()) {
  const folder = mkdtempSync(`${above}/gltfx-target-`);
  try {
    for (const [name, bytes] of files) {
      mkdirSync(dirname(`${folder}/${name}`), { recursive: true });
      writeFileSync(`${folder}/${name}`, bytes);
    }
    return await use(`${folder}/${main}`, folder);
  } finally {
    rmSync(folder, { recursive: true, maxRetries: 5 });
  }
}

const mark = 'ANSWER ';

// Starting takes long on a busy machine.
export const limit = 600000;

// above: the folder of the files. named(path): how the program names them. ask(path): asks for an answer, in place of a
// line of the standard input. env: variables of the program.
export function program(command, args, { above, named = path => path, ask, env = {} } = {}) {
  let child;
  let waiting = null;
  process.on('exit', () => child?.kill());
  const start = () => {
    child = spawn(command, args, { stdio: ['pipe', 'pipe', 'ignore'], env: { ...process.env, ...env } });
    createInterface({ input: child.stdout }).on('line', line => {
      if (line === 'LOADED' && waiting) waiting.loaded = true;
      const [path, answer] = line.split('\t');
      if (!waiting || path !== mark + waiting.path) return;
      try { waiting.done(JSON.parse(answer)); } catch (error) { waiting.failed(new Error(`harness: ${error.message}`)); }
    });
    child.on('exit', code => {
      child = null;
      waiting?.failed(new Error(`${waiting.loaded ? 'harness: ' : ''}the program ended (${code})`));
    });
    child.on('error', error => waiting?.failed(new Error(`harness: ${error.message}`)));
  };
  const answered = path => new Promise((done, failed) => {
    waiting = { path, done, failed };
    if (!child) start();
    if (ask) ask(path);
    else child.stdin.write(`${path}\n`);
  });
  return {
    load: (files, main) => withFiles(files, main, async (path, folder) => {
      const answer = await answered(named(path));
      if (answer.refused !== undefined) throw new Error(answer.refused);
      const { parts = [], ...facts } = answer.facts;
      return { dump: answer.dump?.replaceAll(named(folder), ''), facts: { ...corners(parts.map(part => ({ ...part, attributes: readers(part.attributes), place: v => v }))), ...facts } };
    }, above),
  };
}

// Lists of elements by name as functions of the index.
const readers = attributes => Object.fromEntries(Object.entries(attributes).map(([name, list]) => [name, i => list[i] ?? []]));

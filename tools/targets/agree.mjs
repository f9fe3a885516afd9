// SPDX-License-Identifier: Apache-2.0
// Compares predictions of gltfx for real assets with engines: agree.mjs FOLDER TARGET... prints for each target, in its
// newest version, how many assets were refused and found, how many refusals were false, and how often gltfx is right
// about an extension: ignored, or read. GLTFX names the program; assets with other errors are left out.
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { basename, dirname, join, normalize, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { ofHarness, openEngine } from './loading.mjs';
import { asIfNamed, stranger } from './probes/index.mjs';
import { outcomesOf } from './target_file.mjs';

const root = fileURLToPath(new URL('../../', import.meta.url));
const here = fileURLToPath(new URL('.', import.meta.url));
const [folder, ...targets] = process.argv.slice(2);

// A process for each target: engines share no globals.
if (targets.length > 1) {
  for (const target of targets) spawnSync(process.execPath, ['--no-warnings', process.argv[1], folder, target], { stdio: 'inherit' });
  process.exit(0);
}

// The asset and the files below its folder that it names: bytes by path.
function filesOf(path, json) {
  const names = [];
  JSON.stringify(json, (key, value) => {
    if (/uri$/i.test(key) && typeof value === 'string' && !/^[a-z]+:/i.test(value)) names.push(decodeURIComponent(value));
    return value;
  });
  const there = names.map(name => normalize(name)).filter(name => !name.startsWith('..') && existsSync(join(dirname(path), name)));
  return new Map([basename(path), ...there].map(name => [name, readFileSync(join(dirname(path), name))]));
}

function jsonOf(path) {
  const bytes = readFileSync(path);
  if (bytes.toString('latin1', 0, 4) !== 'glTF') return { json: JSON.parse(bytes.toString().replace(/^\ufeff/, '')) };
  const length = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.toString('utf8', 20, 20 + length)), chunks: bytes.subarray(20 + length) };
}

// The same asset with another text: a GLB keeps its chunks.
function withJson({ chunks }, json) {
  const text = Buffer.from(JSON.stringify(json));
  if (!chunks) return text;
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 0x20)]);
  const head = Buffer.alloc(20);
  head.write('glTF', 0, 'latin1');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(20 + padded.length + chunks.length, 8);
  head.writeUInt32LE(padded.length, 12);
  head.write('JSON', 16, 'latin1');
  return Buffer.concat([head, padded, chunks]);
}

const [target] = targets;
const config = JSON.parse(readFileSync(`${here}targets.json`, 'utf8'))[target];
const measured = outcomesOf(JSON.parse(readFileSync(`${root}schema/targets/${target}.json`, 'utf8')));
const version = [...measured.keys()].at(-1);
const run = spawnSync(process.env.GLTFX ?? `${root}build/dev/bin/gltfx`, ['validate', '--target', `${target}@${version}`, '--format', 'json', folder], { encoding: 'utf8', maxBuffer: 1 << 28 });
const attempt = await openEngine(config.engine ?? target.replaceAll('-', '_'), `${root}build/targets/npm/${config.folder ?? target}-${version}`, `${root}build/targets/npm/tools`);

// The predictions of findings: a refusal, and ignored extensions.
function prediction(findings) {
  const texts = code => findings.filter(it => it.code === code).map(it => it.message);
  return { refusal: texts('TARGET_REFUSES')[0], ignored: new Set(texts('TARGET_IGNORES').map(it => it.match(/ ignores ([A-Z0-9]+_\w+):/)?.[1])) };
}

// The asset with another name for an extension that is not required.
function renamed(json, name) {
  const other = JSON.parse(JSON.stringify(json).replaceAll(`"${name}"`, `"${stranger(name)}"`));
  const required = (other.extensionsRequired ?? []).filter(it => it !== stranger(name));
  delete other.extensionsRequired;
  return required.length > 0 ? { ...other, extensionsRequired: required } : other;
}

const counts = { assets: 0, refused: 0, found: 0, predicted: 0, falseRefusals: 0, pairs: 0, right: 0, harness: 0 };
const notes = [];
for (const { path, readable, findings } of JSON.parse(run.stdout).files) {
  if (!readable || findings.some(it => it.severity === 'error' && !it.code.startsWith('TARGET_'))) continue;
  const asset = jsonOf(path);
  const files = filesOf(path, asset.json);
  const { refusal, ignored } = prediction(findings);
  const it = await attempt(files, basename(path));
  if (it.error && ofHarness(it.error)) {
    counts.harness += 1;
    notes.push(`${relative(folder, path)}: not compared. ${`${it.error.message ?? it.error}`.slice(0, 200)}`);
    continue;
  }
  counts.assets += 1;
  counts.refused += it.error ? 1 : 0;
  counts.predicted += refusal ? 1 : 0;
  counts.found += refusal && it.error ? 1 : 0;
  counts.falseRefusals += refusal && !it.error ? 1 : 0;
  if (Boolean(refusal) !== Boolean(it.error)) notes.push(`${relative(folder, path)}: ${refusal ?? 'no refusal predicted'} ${it.error ? `Refused: ${it.error.message ?? it.error}`.slice(0, 200) : 'Loaded.'}`);
  if (it.error || it.dump === undefined) continue;
  for (const name of asset.json.extensionsUsed ?? []) {
    const inFile = JSON.stringify(asset.json).includes(`"${name}":`);
    if (!inFile || !Object.values(measured.get(version)[name] ?? {}).length) continue;
    const twin = await attempt(new Map([...files, [basename(path), withJson(asset, renamed(asset.json, name))]]), basename(path));
    if (twin.error && ofHarness(twin.error)) continue;
    const actual = !twin.error && asIfNamed(name, twin.dump) === it.dump;
    counts.pairs += 1;
    counts.right += actual === ignored.has(name) ? 1 : 0;
    if (actual !== ignored.has(name)) notes.push(`${relative(folder, path)}: ${name} is ${actual ? 'ignored' : 'read'}`);
  }
}

process.stdout.write(`${target}@${version}: ${JSON.stringify(counts)}\n${notes.map(note => `  ${note}\n`).join('')}`, () => process.exit(0));

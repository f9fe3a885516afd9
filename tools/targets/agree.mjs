// SPDX-License-Identifier: Apache-2.0
// Compares what a target file predicts of real assets with what the engine does:
// agree.mjs FOLDER TARGET... prints for each target, in its newest version, how many predicted refusals came true, how many
// refusals were false, and how often a prediction that an extension is ignored or read is right. GLTFX names the
// program gltfx; assets with errors are left out.
import { spawnSync } from 'node:child_process';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { basename, dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { ofHarness, openEngine } from './loading.mjs';
import { stranger } from './probes/index.mjs';
import { outcomesOf } from './target_file.mjs';

const root = fileURLToPath(new URL('../../', import.meta.url));
const here = fileURLToPath(new URL('.', import.meta.url));
const [folder, ...targets] = process.argv.slice(2);

// A process for each target, since engines share no globals; the assets without errors are found once.
if (!process.env.GLTFX_VALID_ASSETS) {
  const run = spawnSync(process.env.GLTFX ?? `${root}build/dev/bin/gltfx`, ['validate', '--format', 'json', folder], { encoding: 'utf8', maxBuffer: 1 << 28 });
  const valid = JSON.parse(run.stdout).files.filter(it => it.readable && !it.findings.some(finding => finding.severity === 'error')).map(it => it.path);
  for (const target of targets)
    spawnSync(process.execPath, ['--no-warnings', process.argv[1], folder, target], { stdio: 'inherit', env: { ...process.env, GLTFX_VALID_ASSETS: JSON.stringify(valid) } });
  process.exit(0);
}

const walk = path => readdirSync(path).sort().flatMap(name => (statSync(join(path, name)).isDirectory() ? walk(join(path, name)) : [join(path, name)]));

function jsonOf(path) {
  const bytes = readFileSync(path);
  if (bytes.toString('latin1', 0, 4) !== 'glTF') return { json: JSON.parse(bytes.toString().replace(/^\ufeff/, '')) };
  const length = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.toString('utf8', 20, 20 + length)), chunks: bytes.subarray(20 + length), count: bytes.length > 20 + length + 8 ? 2 : 1 };
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

// Features other than extensions that some engine refuses.
const detect = {
  'texture.no-source': ({ json }) => json.textures?.some(it => it.source === undefined && !it.extensions),
  'scene.none': ({ json }) => !json.scenes?.length,
  'primitive.no-positions': ({ json }) => json.meshes?.some(mesh => mesh.primitives.some(it => it.attributes.POSITION === undefined && !it.extensions)),
  'asset.version-2.1': ({ json }) => json.asset.version === '2.1',
  'asset.min-version-2.1': ({ json }) => json.asset.minVersion === '2.1',
  'accessor.zeros': ({ json }) => json.accessors?.some(it => it.bufferView === undefined && !it.sparse && !it.extensions) && !json.extensionsUsed?.includes('KHR_draco_mesh_compression'),
  'extension.unknown-required': ({ json }, known) => json.extensionsRequired?.some(name => !known.has(name)),
};

const fallback = {
  KHR_draco_mesh_compression: json => json.meshes.every(mesh => mesh.primitives.every(it => !it.extensions?.KHR_draco_mesh_compression || Object.values(it.attributes).every(i => json.accessors[i].bufferView !== undefined))),
};
const textureFallback = name => json => (json.textures ?? []).every(it => !it.extensions?.[name] || it.source !== undefined);
const bufferFallback = name => json => (json.buffers ?? []).every(it => !it.extensions?.[name]?.fallback);
for (const name of ['KHR_texture_basisu', 'EXT_texture_webp', 'EXT_texture_avif']) fallback[name] = textureFallback(name);
for (const name of ['EXT_meshopt_compression', 'KHR_meshopt_compression']) fallback[name] = bufferFallback(name);

const modeOf = (json, name) => (!json.extensionsRequired?.includes(name) ? 'used' : fallback[name]?.(json) ? 'requiredWithFallback' : 'required');

function predictions(asset, outcomes, known) {
  const all = new Map();
  for (const name of asset.json.extensionsUsed ?? []) if (outcomes[name]) all.set(name, outcomes[name][modeOf(asset.json, name)]);
  for (const [name, has] of Object.entries(detect)) if (outcomes[name]?.used === 'refused' && has(asset, known)) all.set(name, 'refused');
  return all;
}

const [target] = targets;
const config = JSON.parse(readFileSync(`${here}targets.json`, 'utf8'))[target];
const measured = outcomesOf(JSON.parse(readFileSync(`${root}schema/targets/${target}.json`, 'utf8')));
const version = [...measured.keys()].at(-1);
const outcomes = measured.get(version);
const known = new Set(Object.keys(JSON.parse(readFileSync(`${root}schema/targets/features.json`, 'utf8')).features));
const attempt = await openEngine(config.engine ?? target.replaceAll('-', '_'), `${root}build/targets/npm/${config.folder ?? target}-${version}`, `${root}build/targets/npm/tools`);

const counts = { assets: 0, refused: 0, found: 0, predicted: 0, falseRefusals: 0, pairs: 0, right: 0, harness: 0 };
const notes = [];
for (const path of JSON.parse(process.env.GLTFX_VALID_ASSETS)) {
  const asset = jsonOf(path);
  const place = dirname(path);
  const files = new Map(walk(place).filter(name => statSync(name).size < 1 << 24).map(name => [relative(place, name), readFileSync(name)]));
  const expected = predictions(asset, outcomes, known);
  const refusal = [...expected].find(([, outcome]) => outcome === 'refused');
  const it = await attempt(files, basename(path));
  if (it.error && ofHarness(it.error)) { counts.harness += 1; continue; }
  counts.assets += 1;
  counts.refused += it.error ? 1 : 0;
  counts.predicted += refusal ? 1 : 0;
  counts.found += refusal && it.error ? 1 : 0;
  if (refusal && !it.error) counts.falseRefusals += 1;
  if (Boolean(refusal) !== Boolean(it.error)) notes.push(`${relative(folder, path)}: predicted ${refusal ?? 'no refusal'}, ${it.error ? `refused: ${it.error.message ?? it.error}`.slice(0, 200) : 'loaded'}`);
  if (it.error || it.dump === undefined) continue;
  for (const [name, outcome] of expected) {
    if (!['ignored', 'read'].includes(outcome) || !JSON.stringify(asset.json).includes(`"${name}":`)) continue;
    const other = JSON.parse(JSON.stringify(asset.json).replaceAll(`"${name}"`, `"${stranger(name)}"`));
    if (other.extensionsRequired) other.extensionsRequired = other.extensionsRequired.filter(it => it !== stranger(name));
    if (other.extensionsRequired?.length === 0) delete other.extensionsRequired;
    const twin = await attempt(new Map([...files, [basename(path), withJson(asset, other)]]), basename(path));
    if (twin.error && ofHarness(twin.error)) continue;
    const actual = !twin.error && twin.dump.replaceAll(stranger(name), name).replaceAll(stranger(name).toLowerCase(), name.toLowerCase()) === it.dump ? 'ignored' : 'read';
    counts.pairs += 1;
    counts.right += actual === outcome ? 1 : 0;
    if (actual !== outcome) notes.push(`${relative(folder, path)}: ${name} is ${actual}, predicted ${outcome}`);
  }
}

process.stdout.write(`${target}@${version}: ${JSON.stringify(counts)}\n${notes.map(note => `  ${note}\n`).join('')}`, () => process.exit(0));

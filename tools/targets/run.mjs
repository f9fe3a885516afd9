// SPDX-License-Identifier: Apache-2.0
// Measures one version of an engine: run.mjs ENGINE PACKAGES TOOLS [FEATURE...]. Prints outcomes as JSON.
import { probes, stranger } from './probes/index.mjs';

const [engine, packages, tools, ...features] = process.argv.slice(2);
const wanted = it => features.length === 0 || features.some(f => it.feature === f);
process.on('unhandledRejection', () => {});
process.on('uncaughtException', () => {});
const told = process.env.GLTFX_TARGETS_LOG ? (...text) => process.stderr.write(`${text.join(' ')}\n`) : () => {};
for (const name of ['log', 'warn', 'error', 'info', 'debug']) console[name] = () => {};

const adapter = await import(`./engines/${engine}.mjs`);
const host = await adapter.open(packages, tools).catch(error => {
  process.stderr.write(`${engine} is not measured: ${error.stack}\n`);
  process.exit(1);
});
const limit = adapter.limit ?? 10000;

// { dump, facts } of an asset, or { error }.
const known = new Map();
async function loaded(asset) {
  const key = asset.digest();
  if (!known.has(key)) known.set(key, await attempt(asset));
  return known.get(key);
}
async function attempt(asset) {
  const written = asset.written();
  let timer;
  const late = new Promise((_, failed) => { timer = setTimeout(() => failed(new Error('harness: no answer')), limit); });
  try {
    return await Promise.race([host.load(new Map(written), written[0][0]), late]);
  } catch (error) {
    return { error: error ?? new Error('refused without a reason') };
  } finally {
    clearTimeout(timer);
  }
}

// A failure of the harness is none of the engine.
const ofHarness = error => error instanceof ReferenceError || /harness:|is not defined|Illegal invocation|structuredClone|OffscreenCanvas|WebGL|reading '[A-Z0-9_]{4,}'|https:\/\//.test(`${error?.message ?? error}`);
const equal = (a, b, keys) => keys.every(key => JSON.stringify(a[key]) === JSON.stringify(b[key]));
const hasAll = (names, wanted) => wanted.every(name => names.filter(x => x === name).length >= wanted.filter(x => x === name).length);

async function outcome(probe) {
  const twin = await loaded(probe.twin);
  if (twin.error) return null;
  const it = await loaded(probe.asset);
  if (it.error) {
    told(probe.name, '|', it.error?.stack ?? it.error);
    return ofHarness(it.error) ? null : 'refused';
  }
  if (probe.names) return it.facts.names ? (hasAll(it.facts.names, probe.names) ? 'read' : 'ignored') : null;
  const keys = probe.same ?? probe.differs;
  if (keys) {
    if (keys.length === 0 || keys.some(key => it.facts[key] === undefined || twin.facts[key] === undefined)) return null;
    return equal(it.facts, twin.facts, keys) === Boolean(probe.same) ? 'read' : 'ignored';
  }
  if (it.dump === undefined) return null;
  // Some engines write names in lower case.
  const plain = text => text.replaceAll(stranger(probe.feature), probe.feature).replaceAll(stranger(probe.feature).toLowerCase(), probe.feature.toLowerCase());
  if (it.dump === twin.dump) return 'ignored';
  if (!probe.renamed) return 'read';
  const renamed = await loaded(probe.renamed);
  return !renamed.error && it.dump === plain(renamed.dump) ? 'ignored' : 'read';
}

const outcomes = {};
const all = probes();
// An engine that does not load the plain model, or builds another one the second time, is not measured.
const base = all.find(probe => probe.feature === 'KHR_materials_unlit').twin;
const textured = all.find(probe => probe.feature === 'KHR_texture_transform').twin;
await attempt(textured);
const [first, again] = [await attempt(textured), await attempt(textured)];
const empty = (await attempt(base)).facts?.corners?.length === 0;
if (first.error || again.error || first.dump !== again.dump || empty) {
  process.stderr.write(`${engine} is not measured: ${first.error?.stack ?? again.error?.stack ?? 'the plain model is not built twice alike'}\n`);
  if (process.env.GLTFX_TARGETS_LOG && !first.error) {
    const [a, b] = [first.dump.split('\n'), again.dump.split('\n')];
    a.forEach((line, i) => { if (line !== b[i]) told(`${line.slice(0, 1500)}\n${b[i]?.slice(0, 1500)}\n`); });
  }
  process.exit(1);
}
for (const probe of all.filter(wanted)) {
  const result = await outcome(probe);
  if (result) (outcomes[probe.feature] ??= {})[probe.mode] = result;
}
process.stdout.write(`${JSON.stringify(outcomes)}\n`, () => process.exit(0));

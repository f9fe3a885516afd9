// SPDX-License-Identifier: Apache-2.0
// Measures one version of an engine: run.mjs ENGINE PACKAGES TOOLS [FEATURE...]. Prints outcomes as JSON.
import { ofHarness, openEngine, told } from './loading.mjs';
import { asIfNamed, probes } from './probes/index.mjs';

const [engine, packages, tools, ...features] = process.argv.slice(2);
const attempt = await openEngine(engine, packages, tools);

// { dump, facts } of an asset, or { error }.
const known = new Map();
async function loaded(asset) {
  const key = asset.digest();
  if (!known.has(key)) known.set(key, await fresh(asset));
  return known.get(key);
}
function fresh(asset) {
  const written = asset.written();
  return attempt(new Map(written), written[0][0]);
}

const equal = (a, b, keys) => keys.every(key => JSON.stringify(a[key]) === JSON.stringify(b[key]));
const hasAll = (names, wanted) => wanted.every(name => names.filter(x => x === name).length >= wanted.filter(x => x === name).length);

async function outcome(probe) {
  const twin = await loaded(probe.twin);
  if (twin.error) return null;
  if (probe.of && ignores(probe.of, twin, await loaded(probe.renamed))) return null;
  const it = await loaded(probe.asset);
  if (it.error) {
    told(probe.name, '|', it.error?.stack ?? it.error);
    return ofHarness(it.error) ? null : 'refused';
  }
  if (it.picture) told(probe.name, 'differs by', difference(it.picture, twin.picture));
  if (it.picture && probe.like && !alike(it.picture, (await loaded(probe.like)).picture)) return probe.of ? null : 'ignored';
  if (it.picture) return probe.seen ? (drawn(probe, difference(it.picture, twin.picture)) ? 'drawn' : 'ignored') : null;
  if (probe.names) {
    const among = it.facts[probe.among ?? 'names'];
    return among ? (hasAll(among, probe.names) ? 'read' : 'ignored') : null;
  }
  const keys = probe.same ?? probe.differs;
  if (keys) {
    if (keys.length === 0 || keys.some(key => it.facts[key] === undefined || twin.facts[key] === undefined)) return null;
    if (probe.same && keys.every(key => it.facts[key].length === 0 && twin.facts[key].length === 0)) return null;
    return equal(it.facts, twin.facts, keys) === Boolean(probe.same) ? 'read' : 'ignored';
  }
  if (it.dump === twin.dump) return 'ignored';
  if (!probe.renamed || probe.of) return 'read';
  return ignores(probe.feature, it, await loaded(probe.renamed)) ? 'ignored' : 'read';
}

// Whether the engine builds the same without the probed extension.
const ignores = (name, it, renamed) => !renamed.error
  && (it.picture ? !drawn({}, difference(it.picture, renamed.picture)) : it.dump === asIfNamed(name, renamed.dump));

// The share of pixels of two pictures that differ visibly. Pictures of the same model may differ at edges.
function difference(a, b) {
  let count = 0;
  for (let i = 0; i < a.length; i += 4) count += [0, 1, 2, 3].some(c => Math.abs(a[i + c] - b[i + c]) > 6) ? 1 : 0;
  return count / (a.length / 4);
}
// Whether two pictures are the same but for what lossy compression changes.
const alike = (a, b) => a.reduce((sum, v, i) => sum + Math.abs(v - b[i]), 0) / a.length < 6;
const drawn = (probe, share) => (probe.same ? share < 0.04 : share > 0.002);

const all = probes();
const feature = name => all.find(probe => probe.feature === name);
// An engine that does not load the plain models, or builds different objects the second time, is not measured. Objects
// that it makes once are made before.
const [plain, textured] = [feature('KHR_materials_unlit').twin, feature('KHR_texture_transform').twin];
await fresh(textured);
const [first, again, shape] = [await fresh(textured), await fresh(textured), await fresh(plain)];
const unequal = first.picture ? difference(first.picture, again.picture) > 0 || difference(first.picture, shape.picture) < 0.02 : first.dump !== again.dump || shape.facts?.corners?.length === 0;
if (first.error || again.error || shape.error || unequal) {
  process.stderr.write(`${engine} is not measured: ${(first.error ?? again.error ?? shape.error)?.stack ?? 'the plain model is not built twice alike'}\n`);
  if (first.dump && again.dump)
    again.dump.split('\n').forEach((line, i) => { if (line !== first.dump.split('\n')[i]) told(line.slice(0, 1500)); });
  process.exit(1);
}
const outcomes = {};
for (const probe of all.filter(it => features.length === 0 || features.includes(it.feature))) {
  const result = await outcome(probe);
  told(probe.name, result);
  if (result) (outcomes[probe.feature] ??= {})[probe.mode] = result;
}
process.stdout.write(`${JSON.stringify(outcomes)}\n`, () => process.exit(0));

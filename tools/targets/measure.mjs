// SPDX-License-Identifier: Apache-2.0
// Measures targets and writes their files: measure.mjs [--check] [--packages FOLDER] [--out FOLDER] [--feature NAMES]
// [TARGET[@VERSION]...]. A version that is not named keeps the outcomes it has in the file, and so does another feature;
// "@newest" names the newest of a target.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { compareVersions, outcomesOf, targetText } from './target_file.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
const root = fileURLToPath(new URL('../../', import.meta.url));
const args = process.argv.slice(2);
const check = args.includes('--check');
const option = (name, otherwise) => (args.includes(name) ? args[args.indexOf(name) + 1] : otherwise);
const store = option('--packages', `${root}build/targets/npm`);
const out = option('--out', `${root}schema/targets`);
const features = option('--feature', '').split(',').filter(Boolean);
const wanted = args.filter((arg, i) => !arg.startsWith('--') && !['--packages', '--out', '--feature'].includes(args[i - 1]));
const targets = JSON.parse(readFileSync(`${here}targets.json`, 'utf8'));

const newest = name => [...targets[name].versions].sort(compareVersions).at(-1);
const chosen = (name, version) => wanted.length === 0 || wanted.includes(name) || wanted.includes(`${name}@${version}`)
  || (version === newest(name) && (wanted.includes('@newest') || wanted.includes(`${name}@newest`)));

// Outcomes of one version by feature and mode, or null.
function measure(name, target, version) {
  const folder = `${store}/${target.folder ?? name}-${version}`;
  const result = spawnSync(process.execPath, ['--no-warnings', '--max-old-space-size=4096', `${here}run.mjs`, target.engine ?? name.replaceAll('-', '_'), folder, `${root}build/targets/npm/tools`, ...features],
    { encoding: 'utf8', maxBuffer: 1 << 26, stdio: ['ignore', 'pipe', 'inherit'] });
  if (result.status !== 0) {
    process.stderr.write(`${name} ${version}: not measured\n`);
    return null;
  }
  return JSON.parse(result.stdout);
}

function npmInstall(name, target, version) {
  const folder = `${store}/${target.folder ?? name}-${version}`;
  if (target.source.startsWith('npm:') === false || existsSync(`${folder}/node_modules`)) return;
  mkdirSync(folder, { recursive: true });
  const done = spawnSync('npm', ['install', '--silent', '--no-audit', '--no-fund', '--no-package-lock', '--ignore-scripts', '--legacy-peer-deps', '--prefix', folder,
    ...target.packages.map(p => `${p}@${version}`)], { stdio: ['ignore', 'ignore', 'inherit'] });
  if (done.status !== 0) throw new Error(`npm cannot install ${name} ${version}`);
}

let failed = false;
for (const [name, target] of Object.entries(targets)) {
  if (!target.versions.some(version => chosen(name, version))) continue;
  const path = `${root}schema/targets/${name}.json`;
  const before = existsSync(path) ? readFileSync(path, 'utf8') : '';
  const known = before ? outcomesOf(JSON.parse(before)) : new Map();
  const outcomes = new Map();
  for (const version of [...target.versions].sort(compareVersions)) {
    if (chosen(name, version)) {
      npmInstall(name, target, version);
      const result = measure(name, target, version);
      const kept = Object.entries(features.length ? known.get(version) ?? {} : {}).filter(([name]) => !features.includes(name));
      if (result) outcomes.set(version, { ...Object.fromEntries(kept), ...result });
      else failed = true;
    } else if (known.has(version)) {
      outcomes.set(version, known.get(version));
    }
  }
  if (outcomes.size === 0) continue;
  const text = targetText(name, target, outcomes);
  if (check && text !== before) {
    failed = true;
    process.stderr.write(`${path} is not what was measured\n`);
    writeFileSync(`${root}build/targets/${name}.json`, text);
  } else if (!check) {
    writeFileSync(`${out}/${name}.json`, text);
  }
  process.stdout.write(`${name}: ${outcomes.size} versions\n`);
}
process.exit(failed ? 1 : 0);

// SPDX-License-Identifier: Apache-2.0
// The text of a target file, from outcomes by version, and back.

export function compareVersions(a, b) {
  const [x, y] = [a, b].map(v => v.split('.').map(Number));
  for (let i = 0; i < Math.max(x.length, y.length); ++i)
    if ((x[i] ?? 0) !== (y[i] ?? 0)) return (x[i] ?? 0) - (y[i] ?? 0);
  return 0;
}

// Outcomes of a file: a map from version to { feature: { mode: outcome } }.
export function outcomesOf(file) {
  const versions = file.versions.map(it => it.version);
  const all = new Map(versions.map(version => [version, {}]));
  for (const [feature, modes] of Object.entries(file.features))
    for (const [mode, outcomes] of Object.entries(modes)) {
      const ranges = typeof outcomes === 'string' ? [{ since: versions[0], until: versions.at(-1), outcome: outcomes }] : outcomes;
      for (const { since, until, outcome } of ranges)
        for (const version of versions.slice(versions.indexOf(since), versions.indexOf(until) + 1)) (all.get(version)[feature] ??= {})[mode] = outcome;
    }
  return all;
}

// Neighbours of the same outcome are one range.
function ranges(versions, outcomeIn) {
  const out = [];
  let open = false;
  for (const version of versions) {
    const outcome = outcomeIn(version);
    if (outcome && open && out.at(-1).outcome === outcome) out.at(-1).until = version;
    else if (outcome) out.push({ since: version, until: version, outcome });
    open = Boolean(outcome);
  }
  const whole = out.length === 1 && out[0].since === versions[0] && out[0].until === versions.at(-1);
  return whole ? out[0].outcome : out;
}

const modes = ['used', 'required', 'requiredWithFallback'];

// outcomes: a map from version to { feature: { mode: outcome } }. One line for each version and feature.
export function targetText(name, target, outcomes) {
  const versions = [...outcomes.keys()].sort(compareVersions);
  const features = new Set([...outcomes.values()].flatMap(Object.keys));
  const lines = [...features].sort().map(feature => {
    const entry = {};
    for (const mode of modes) {
      const list = ranges(versions, version => outcomes.get(version)[feature]?.[mode]);
      if (list.length > 0) entry[mode] = list;
    }
    return `    ${JSON.stringify(feature)}: ${JSON.stringify(entry)}`;
  });
  const head = { format: 1, name, title: target.title, source: target.source, setUp: target.setUp, decoders: target.decoders, measured: target.measured ?? 'objects', method: target.method };
  const released = target.released ?? {};
  return `{
${Object.entries(head).filter(([, value]) => value !== undefined).map(([key, value]) => `  ${JSON.stringify(key)}: ${JSON.stringify(value)}`).join(',\n')},
  "versions": [
${versions.map(version => `    ${JSON.stringify({ version, released: released[version] })}`).join(',\n')}
  ],
  "features": {
${lines.join(',\n')}
  }
}
`;
}

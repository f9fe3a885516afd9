// SPDX-License-Identifier: Apache-2.0
// All probes: [{ name, feature, mode, asset, twin, renamed?, of?, same?, differs?, names?, among?, like?, seen }].
//   same:    facts that must be equal for the asset and its twin, which means the same without the feature
//   differs: facts of which at least one must differ from the twin; without it, any object of the engine
//   names:   names that must be in the list `among` of facts (names), each as often as here
//   renamed: the asset with an unknown extension in place of the probed one; with `of`, the twin
//   of:      the extension that the feature is a part of; an engine that ignores it says nothing about the feature
//   like:    an asset whose picture is about that of the probe: some engines draw what they cannot read in a color of their own
//   seen:    whether a picture at rest can show it
import { extensions } from './extensions.mjs';
import { files } from './files.mjs';
import { geometry } from './geometry.mjs';
import { scene } from './scenes.mjs';

// An unknown name, of the same length and at the same place in a sorted list.
export const stranger = name => `${name.slice(0, -1)}Z`;
// A dump as if it had the known name. Some engines write names in lower case.
export const asIfNamed = (name, text) => text.replaceAll(stranger(name), name).replaceAll(stranger(name).toLowerCase(), name.toLowerCase());

// Features that no picture at rest shows.
const unseen = [/^animation\./, /^attribute\.(custom|color-1|texcoord-[0-9]|tangent)$/, /^morph\.target-names$/, /^node\.name/, /^extras$/,
  /^scene\.several$/, /^asset\.min/, /^camera\./, /^node\.negative-scale$/, /^morph\.(normal|tangent|texcoord)$/, /^texture\.sampler-no-mipmaps$/, /^primitive\.no-material$/, /^material\.(occlusion|blended-sheen-specular)/,
  /^(AGI_|FB_|GRIFFEL_|GODOT_|KHR_XMP|KHR_xmp|KHR_interactivity|KHR_node_(hover|select)ability|KHR_animation_pointer|KHR_materials_variants|EXT_mesh_manifold|MPEG_|MSFT_lod|EXT_(structural_metadata|(mesh|instance)_features))/, /^structural-metadata\./];

// The asset with another name for the extension, used but not required.
function renamed(asset, name) {
  const other = asset.copy();
  other.json = JSON.parse(JSON.stringify(asset.json).replaceAll(`"${name}"`, `"${stranger(name)}"`).replaceAll(`"${name}:`, `"${stranger(name)}:`));
  delete other.json.extensionsRequired;
  return other;
}

function extensionProbe(name, mode, make) {
  const { asset, twin, same, like } = make();
  for (const other of ['KHR_materials_transmission', 'KHR_materials_volume', 'KHR_materials_clearcoat'])
    if (JSON.stringify(twin.json).includes(`"${other}"`)) twin.uses(other);
  asset.json.extensionsUsed = [...(twin.json.extensionsUsed ?? [])];
  asset.uses(name, mode !== 'used');
  return { name: `${name} ${mode}`, feature: name, mode, asset, twin, same, like, ...(!same && { renamed: renamed(asset, name) }) };
}

export function probes() {
  const all = [];
  for (const [name, entry] of Object.entries(extensions)) {
    const ways = typeof entry === 'function' ? { used: entry, required: entry } : entry;
    for (const [mode, make] of Object.entries(ways)) all.push(extensionProbe(name, mode, make));
  }
  for (const [name, make] of Object.entries({ ...files, ...geometry, ...scene })) {
    const probe = { name: `${name} used`, feature: name, mode: 'used', ...make() };
    all.push({ ...probe, ...(probe.of && { renamed: renamed(probe.twin, probe.of) }) });
  }
  for (const probe of all) probe.seen = !unseen.some(pattern => pattern.test(probe.feature));
  return all.sort((a, b) => (a.name < b.name ? -1 : 1));
}

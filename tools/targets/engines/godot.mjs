// SPDX-License-Identifier: Apache-2.0
// Godot: the editor imports assets of a project, without a window.
import { copyFileSync, mkdirSync, mkdtempSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { fileURLToPath } from 'node:url';
import { program } from './process.mjs';

export const limit = 60000;

export async function open() {
  const project = mkdtempSync(`${tmpdir()}/gltfx-godot-`);
  process.on('exit', () => rmSync(project, { recursive: true, force: true }));
  const plugin = `${project}/addons/answer`;
  mkdirSync(plugin, { recursive: true });
  copyFileSync(fileURLToPath(new URL('godot.gd', import.meta.url)), `${plugin}/godot.gd`);
  writeFileSync(`${plugin}/plugin.cfg`, '[plugin]\nname="answer"\ndescription=""\nauthor=""\nversion=""\nscript="godot.gd"\n');
  writeFileSync(`${project}/project.godot`, 'config_version=4\n[application]\nconfig/name="gltfx"\n[editor_plugins]\nenabled=PoolStringArray( "answer" )\n');
  const ask = path => {
    writeFileSync(`${project}/asking`, path);
    renameSync(`${project}/asking`, `${project}/asked`);
  };
  const named = path => path.replace(project, 'res:/');
  return program('godot3-server', ['--path', project, '--editor'], { above: project, named, ask, env: { HOME: `${project}/.home`, LANG: 'en_US.UTF-8' } });
}

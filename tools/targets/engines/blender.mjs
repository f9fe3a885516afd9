// SPDX-License-Identifier: Apache-2.0
// Blender's importer of glTF, without a window.
import { fileURLToPath } from 'node:url';
import { program } from './process.mjs';

export { limit } from './process.mjs';

export const open = async () => program('blender', ['-b', '--factory-startup', '-P', fileURLToPath(new URL('blender.py', import.meta.url))]);

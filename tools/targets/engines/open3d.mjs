// SPDX-License-Identifier: Apache-2.0
// Open3D: read_triangle_model(), without drawing.
import { fileURLToPath } from 'node:url';
import { program } from './process.mjs';

export { limit } from './process.mjs';

export const open = async () => program('/usr/bin/python3', [fileURLToPath(new URL('open3d_read.py', import.meta.url))]);

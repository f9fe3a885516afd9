// SPDX-License-Identifier: Apache-2.0
// VTK: vtkGLTFImporter, without drawing.
import { fileURLToPath } from 'node:url';
import { program } from './process.mjs';

export { limit } from './process.mjs';

export const open = async () => program('/usr/bin/python3', [fileURLToPath(new URL('vtk_import.py', import.meta.url))]);

// SPDX-License-Identifier: Apache-2.0
// three.js: GLTFLoader without decoders.
import { open as openWith } from './three.mjs';

export const open = (packages, tools) => openWith(packages, tools, { decoders: false });

// SPDX-License-Identifier: Apache-2.0
// The root has the functions of gltfx/compat too, so that an override of gltf-validator finds them.
import { createApi } from "./lib/api.mjs";
import { getEngine } from "./wasm/engine_browser.mjs";
import compat from "./compat-browser.mjs";

export const { validate, fix, upgrade, edit, convert, compare, inspect } = createApi(getEngine);
export { supportedExtensions, validateBytes, validateString, version } from "./compat-browser.mjs";
export default { validate, fix, upgrade, edit, convert, compare, inspect, ...compat };

// SPDX-License-Identifier: Apache-2.0
import { createCompat } from "./lib/compat.mjs";
import { getEngine } from "./wasm/engine_browser.mjs";

const compat = createCompat(getEngine);
export const { supportedExtensions, validateBytes, validateString, version } = compat;
export default compat;

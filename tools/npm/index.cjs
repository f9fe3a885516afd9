// SPDX-License-Identifier: Apache-2.0
// CommonJS.
"use strict";
const compat = require("./compat.cjs");

const loading = import("./index.mjs");
loading.catch(() => {}); // each call reports it

exports.compare = (before, after, options) => loading.then((loaded) => loaded.compare(before, after, options));
for (const name of ["validate", "fix", "upgrade", "edit", "convert", "inspect"]) {
  exports[name] = (asset, options) => loading.then((loaded) => loaded[name](asset, options));
}
exports.version = compat.version;
exports.supportedExtensions = compat.supportedExtensions;
exports.validateBytes = compat.validateBytes;
exports.validateString = compat.validateString;

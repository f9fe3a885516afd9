// SPDX-License-Identifier: Apache-2.0
// CommonJS.
"use strict";
const compat = require("./compat.cjs");

const loading = import("./index.mjs");
loading.catch(() => {}); // each call reports it

exports.validate = (asset, options) => loading.then((loaded) => loaded.validate(asset, options));
exports.upgrade = (asset, options) => loading.then((loaded) => loaded.upgrade(asset, options));
exports.inspect = (asset, options) => loading.then((loaded) => loaded.inspect(asset, options));
exports.version = compat.version;
exports.supportedExtensions = compat.supportedExtensions;
exports.validateBytes = compat.validateBytes;
exports.validateString = compat.validateString;

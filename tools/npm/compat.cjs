// SPDX-License-Identifier: Apache-2.0
// CommonJS: synchronous members are here, the rest is in the module.
"use strict";
const { khronosExtensions, packageVersion } = require("./lib/constants.cjs");

let module_;
const loading = import("./compat.mjs").then((loaded) => (module_ = loaded));
loading.catch(() => {}); // each call reports it

// The bytes are read at the time of the call, also while the module loads.
function now(data) {
  const isBytes = Object.prototype.toString.call(data) === "[object Uint8Array]";
  return isBytes ? Uint8Array.prototype.slice.call(data) : data;
}

exports.version = () => packageVersion;
exports.supportedExtensions = () => [...khronosExtensions];
exports.validateBytes = (data, options) => {
  if (module_) return module_.validateBytes(data, options);
  const copy = now(data);
  return loading.then((loaded) => loaded.validateBytes(copy, options));
};
exports.validateString = (json, options) =>
  module_
    ? module_.validateString(json, options)
    : loading.then((loaded) => loaded.validateString(json, options));

// SPDX-License-Identifier: Apache-2.0
// Checks of arguments. Options that gltfx/compat has too are checked in the same way; an unknown option is refused,
// because it would be ignored.
import { checkEngineOptions, isBytes } from "./compat_options.mjs";
import { PROFILES } from "../wasm/engine.mjs";

const isText = (value) => typeof value === "string";
const isFlag = (value) => typeof value === "boolean";
const isNames = (value) => Array.isArray(value) && value.every((name) => isText(name) && name !== "");
const isSource = (value) => typeof value === "function" || value instanceof Map;
const oneOf = (names) => [(value) => names.includes(value), `one of ${names.join(", ")}`];
const anything = [() => true, ""]; // checkEngineOptions() checks it

const flag = [isFlag, "a boolean"];
const names = [isNames, "an array of non-empty strings"];
const resources = [isSource, "a Map or a function"];
const OPTIONS = {
  validate: {
    uri: [isText, "a string"],
    format: oneOf(["gltf", "glb"]),
    profile: oneOf(PROFILES),
    maxIssues: anything,
    ignoredIssues: anything,
    onlyIssues: anything,
    severityOverrides: anything,
    resources,
  },
  fix: { resources, profile: oneOf(PROFILES), unsafe: flag, only: names, skip: names },
  upgrade: { resources, unsafe: flag, strict: flag, prune: flag, only: names, to: names },
  edit: { resources, delete: names, cascade: flag },
  convert: {
    resources,
    to: oneOf(["glb", "gltf", "embedded"]),
    compress: oneOf(["none", "meshopt"]),
    dedup: flag,
    prune: flag,
    weld: flag,
    reorder: flag,
    resample: flag,
    shrink: flag,
    partial: flag,
  },
  compare: {
    resources,
    oldResources: resources,
    newResources: resources,
    drawn: flag,
    bounds: [isText, "a string"],
    ignore: names,
    count: names,
  },
  inspect: { resources },
};

const misuse = (text) => new TypeError(`gltfx: ${text}`);

function engineOptionsOf(options) {
  try {
    return checkEngineOptions(options);
  } catch (text) {
    throw misuse(text.replace("Invalid argument(s): ", ""));
  }
}

/** The options that are set. Throws a TypeError for misuse. */
export function checkOptions(verb, asset, options) {
  if (!isBytes(asset)) throw misuse("the asset must be a Uint8Array");
  if (options === null || typeof options !== "object" || Array.isArray(options))
    throw misuse("options must be an object");
  const known = OPTIONS[verb];
  const set = Object.entries(options).filter(([, value]) => value !== undefined && value !== null);
  for (const [name, value] of set) {
    if (!Object.hasOwn(known, name))
      throw misuse(`${verb}() has no option '${name}', only ${Object.keys(known).join(", ")}`);
    const [isRight, form] = known[name];
    if (!isRight(value)) throw misuse(`options.${name} must be ${form}`);
  }
  const checked = Object.fromEntries(set);
  if (verb === "edit" && !checked.delete?.length) throw misuse("options.delete must name at least one object");
  return verb === "validate" ? { ...checked, ...engineOptionsOf(checked) } : checked;
}

/** Throws a TypeError for a code that no rule has: it would select nothing. */
export function checkAreCodes(engine, { ignoredIssues, onlyIssues, severityOverrides }) {
  for (const code of [...ignoredIssues, ...onlyIssues, ...Object.keys(severityOverrides)]) {
    if (!engine.isCode(code)) throw misuse(`there is no code '${code}'`);
  }
}

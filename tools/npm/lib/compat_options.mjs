// SPDX-License-Identifier: Apache-2.0
// Checks of arguments in the order and with the messages of npm's gltf-validator: callers match them.
import { normalizeUri } from "./uri.mjs";

const mostIssues = 2 ** 31 - 1;

function invalid(text) {
  return `Invalid argument(s): ${text}`;
}

// A Uint8Array of another realm is accepted, other typed arrays are not.
export function isBytes(value) {
  return ArrayBuffer.isView(value) && value[Symbol.toStringTag] === "Uint8Array";
}

export function checkData(data) {
  if (!isBytes(data)) throw invalid("data: Argument must be a Uint8Array.");
}

export function checkIsObject(options) {
  if (options === undefined || options === null || typeof options === "function") return;
  if (typeof options !== "object" || Array.isArray(options))
    throw invalid("options: Value must be an object.");
}

function checkMaxIssues(limit) {
  if (limit === undefined || limit === null) return 0;
  const isWhole = typeof limit === "number" && (Number.isInteger(limit) || limit === Infinity);
  if (!isWhole || limit < 0) throw invalid("options.maxIssues: Value must be a non-negative integer.");
  return limit > mostIssues ? 0 : limit;
}

function checkCodes(name, codes) {
  if (codes === undefined || codes === null) return [];
  if (!Array.isArray(codes)) throw invalid(`options.${name}: Value must be an array.`);
  return Array.from(codes, (code, index) => {
    if (typeof code === "string" && code !== "") return code;
    throw invalid(`options.${name}[${index}]: Value must be a non-empty String.`);
  });
}

function checkOverrides(overrides) {
  if (overrides === undefined || overrides === null) return {};
  if (["number", "boolean", "string"].includes(typeof overrides) || Array.isArray(overrides)) {
    throw invalid("options.severityOverrides: Value must be an object.");
  }
  const entries = Object.keys(overrides).map((code) => [code, overrides[code]]);
  for (const [code, severity] of entries) {
    if ([0, 1, 2, 3].includes(severity)) continue;
    throw invalid(`options.severityOverrides["${code}"]: Value must be one of [0, 1, 2, 3].`);
  }
  return Object.fromEntries(entries);
}

/** Options of the engine. */
export function checkEngineOptions(options) {
  const format = options?.format ?? undefined;
  if (format !== undefined && typeof format !== "string")
    throw invalid("options.format: Value must be a string.");
  const maxIssues = checkMaxIssues(options?.maxIssues);
  const only = options?.onlyIssues ?? undefined;
  const ignored = options?.ignoredIssues ?? undefined;
  if (only !== undefined && ignored !== undefined) {
    throw invalid("options.onlyIssues cannot be used along with options.ignoredIssues.");
  }
  const onlyIssues = checkCodes("onlyIssues", only);
  const ignoredIssues = checkCodes("ignoredIssues", ignored);
  const severityOverrides = checkOverrides(options?.severityOverrides);
  return { maxIssues, onlyIssues, ignoredIssues, severityOverrides };
}

function checkUri(uri) {
  if (uri === undefined || uri === null) return undefined;
  if (typeof uri !== "string") throw invalid("options.uri: Value must be a string.");
  try {
    return normalizeUri(uri);
  } catch (error) {
    throw invalid(`options.uri: FormatException: ${error.message}.`);
  }
}

/** Options of the report and of fetching resources. */
export function checkReportOptions(options) {
  const uri = checkUri(options?.uri);
  const load = options?.externalResourceFunction ?? undefined;
  if (load !== undefined && typeof load !== "function") {
    throw invalid("options.externalResourceFunction: Value must be a function.");
  }
  const writeTimestamp = options?.writeTimestamp ?? true;
  if (typeof writeTimestamp !== "boolean") throw invalid("options.writeTimestamp: Value must be a boolean.");
  return { uri, load, writeTimestamp };
}

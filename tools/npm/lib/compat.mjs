// SPDX-License-Identifier: Apache-2.0
// The interface of npm's gltf-validator. Promises are rejected with strings, as its promises are.
import {
  checkData,
  checkEngineOptions,
  checkIsObject,
  checkReportOptions,
  isBytes,
} from "./compat_options.mjs";
import { cutAt, withoutResourcesAfter } from "./compat_limit.mjs";
import { khronosExtensions, packageVersion } from "./constants.mjs";
import { normalizeUri } from "./uri.mjs";

const utf8 = new TextEncoder();
const noFunction = "Exception: options.externalResourceFunction is required to load this resource.";
const issuesOfAResource = 8; // at most: about one buffer or image itself

function invalidArgument(text) {
  return `Invalid argument(s): options.externalResourceFunction: ${text}`;
}

// The reason as the other validator formats it when it is not a string.
function textOf(reason) {
  if (reason === undefined || reason === null) return "null";
  if (Array.isArray(reason)) return `[${reason.map(textOf).join(", ")}]`;
  return String(reason);
}

// A function that throws ends the validation.
function thrownText(error) {
  return error instanceof Error ? `Error: ${error.message}` : textOf(error);
}

/** Calls the function of the user: { bytes } or { problem }; throws what ends the validation. */
function ask(load, uri) {
  let settle;
  const settled = new Promise((resolve) => (settle = resolve));
  try {
    const answer = load(uri);
    if (typeof answer?.then !== "function") throw invalidArgument("Function must return a Promise.");
    answer.then(
      (bytes) => settle({ bytes }),
      (reason) => settle({ problem: `Node Exception: ${textOf(reason)}`.trimEnd() }),
    );
  } catch (error) {
    if (error === undefined || error === null)
      return { problem: `Throw of null ('${error}' from JavaScript)` };
    throw thrownText(error);
  }
  return settled;
}

// URIs in the order in which their bytes are requested, each use separately.
function usesIn({ info }) {
  return (info?.resources ?? []).filter(({ storage }) => storage === "external").map(({ uri }) => uri);
}

function hasRoom(report, uses, maxIssues) {
  if (!maxIssues) return true;
  return report.issues.messages.length + issuesOfAResource * uses.length < maxIssues;
}

function describeFailures(report, problems) {
  if (report.issues.messages.length === 0) return;
  const uris = new Map((report.info?.resources ?? []).map(({ pointer, uri }) => [`${pointer}/uri`, uri]));
  for (const message of report.issues.messages) {
    const problem = message.code === "IO_ERROR" ? problems(uris.get(message.pointer)) : undefined;
    if (problem !== undefined) message.message = problem;
  }
}

async function loadResource(load, uri) {
  const { bytes, problem } = await ask(load, uri);
  if (problem !== undefined) return { bytes: null, problem };
  if (!isBytes(bytes)) throw invalidArgument("Promise must be fulfilled with Uint8Array or rejected.");
  return { bytes };
}

// Member by member: spreading them takes a fifth of the time of a small asset.
function engineOptionsOf(options, format, resources) {
  return {
    format,
    profile: "khronos",
    maxIssues: options.maxIssues && options.maxIssues + 1,
    onlyIssues: options.onlyIssues,
    ignoredIssues: options.ignoredIssues,
    severityOverrides: options.severityOverrides,
    resources,
  };
}

/** Validates an asset without external resources. Precondition: the engine is ready. */
function validateAlone(engine, bytes, format, options) {
  const report = JSON.parse(engine.validate(bytes, engineOptionsOf(options, format)).report);
  describeFailures(report, () => noFunction);
  return cutAt(report, options.maxIssues);
}

/** Validates, fetches missing resources, validates again. Near the limit of issues, resources are fetched
    one by one, because what the first one has may be the last that is looked at. */
async function validateWithResources(engine, bytes, format, options, load) {
  const { maxIssues } = options;
  const resources = new Map(); // by the engine's form of the URI
  const results = new Map(); // by the URI in reports; the first answer counts
  const engineOptions = engineOptionsOf(options, format, resources);
  for (let asked = 0; ;) {
    while (!engine.isReady) await engine.start();
    const answer = engine.validate(bytes, engineOptions);
    const report = JSON.parse(answer.report);
    const uses = usesIn(withoutResourcesAfter(report, maxIssues));
    const end = hasRoom(report, uses, maxIssues) ? uses.length : Math.min(asked + 1, uses.length);
    if (asked >= end) {
      describeFailures(report, (uri) => results.get(uri)?.problem);
      return cutAt(report, maxIssues);
    }
    for (; asked < end; ++asked) {
      const result = await loadResource(load, uses[asked]);
      if (!results.has(uses[asked])) results.set(uses[asked], result);
    }
    for (const uri of answer.missing) {
      const result = results.get(normalizeUri(uri));
      if (result) resources.set(uri, result.bytes);
    }
  }
}

// The members are in gltf-validator's order.
function completed(report, format, reportOptions) {
  const mimeType = format === "glb" ? "model/gltf-binary" : report.mimeType;
  const answer = {};
  if (reportOptions.uri !== undefined) answer.uri = reportOptions.uri;
  if (mimeType !== undefined) answer.mimeType = mimeType;
  answer.validatorVersion = packageVersion;
  if (reportOptions.writeTimestamp) answer.validatedAt = new Date().toISOString();
  answer.issues = report.issues;
  if (report.info !== undefined) answer.info = report.info;
  return answer;
}

function formatOf(bytes, format) {
  const name = format?.toLowerCase();
  if (name === "glb" || name === "gltf") return name;
  if (bytes[0] === 0x67) return "glb"; // "g"
  if ([0x7b, 0x20, 0x09, 0x0a, 0x0d, 0xef].includes(bytes[0])) return "gltf";
  throw "Invalid data: could not detect glTF format.";
}

// The length of a view is that of its memory, independent of properties of `data`.
function viewOf({ buffer, byteOffset, byteLength }) {
  return new Uint8Array(buffer, byteOffset, byteLength);
}

export function createCompat(getEngine) {
  let engine; // set when it has started

  // `isOurs`: no other code can change the bytes. Awaits nothing when nothing is pending: each await adds one percent
  // to the time of a small asset.
  async function validate(bytes, isOurs, format, options, reportOptions) {
    const { load } = reportOptions;
    try {
      if (!load && engine?.isReady) {
        return completed(validateAlone(engine, bytes, format, options), format, reportOptions);
      }
      const kept = isOurs ? bytes : new Uint8Array(bytes);
      engine = await getEngine(); // also when it is set: `load` is never called before validateBytes() returns
      if (load) {
        const report = await validateWithResources(engine, kept, format, options, load);
        return completed(report, format, reportOptions);
      }
      while (!engine.isReady) await engine.start();
      return completed(validateAlone(engine, kept, format, options), format, reportOptions);
    } catch (error) {
      throw error instanceof Error ? String(error) : error;
    }
  }

  return {
    version: () => packageVersion,
    supportedExtensions: () => [...khronosExtensions],
    async validateBytes(data, options) {
      checkData(data);
      checkIsObject(options);
      const engineOptions = checkEngineOptions(options);
      const format = formatOf(data, options?.format);
      return validate(viewOf(data), false, format, engineOptions, checkReportOptions(options));
    },
    async validateString(json, options) {
      if (typeof json !== "string") throw "Invalid argument(s): json: Argument must be a string.";
      checkIsObject(options);
      const engineOptions = checkEngineOptions(options);
      // A byte order mark belongs to bytes; in a string it is an unknown character.
      const bytes = utf8.encode(json.replace(/^\ufeff/, "\ufffd"));
      return validate(bytes, true, "gltf", engineOptions, checkReportOptions(options));
    },
  };
}

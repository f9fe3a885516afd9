// SPDX-License-Identifier: Apache-2.0
// The interface of npm's gltf-validator. Promises are rejected with strings, as its promises are.
import { checkData, checkEngineOptions, checkIsObject, checkReportOptions, isBytes } from "./compat_options.mjs";
import { khronosExtensions, packageVersion } from "./constants.mjs";
import { normalizeUri } from "./uri.mjs";

const utf8 = new TextEncoder();
const noFunction = "Exception: options.externalResourceFunction is required to load this resource.";
const issuesOfAResource = 8; // at most: about one buffer or image itself

function invalidArgument(text) {
  return `Invalid argument(s): options.externalResourceFunction: ${text}`;
}

// What the other validator makes of a reason that is no string.
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
    if (error === undefined || error === null) return { problem: `Throw of null ('${error}' from JavaScript)` };
    throw thrownText(error);
  }
  return settled;
}

// URIs in the order in which their bytes are wanted, each use on its own. The one at which the limit of
// issues was reached has no entry in the report.
function usesIn(report, missing) {
  const resources = report.info?.resources ?? [];
  const uses = resources.filter(({ storage }) => storage === "external").map(({ uri }) => uri);
  for (const uri of missing.map(normalizeUri)) if (!uses.includes(uri)) uses.push(uri);
  return uses;
}

function hasRoom(report, uses, maxIssues) {
  if (!maxIssues) return true;
  return !report.issues.truncated && report.issues.messages.length + issuesOfAResource * uses.length < maxIssues;
}

function describeFailures(report, problems) {
  const uris = new Map((report.info?.resources ?? []).map(({ pointer, uri }) => [`${pointer}/uri`, uri]));
  for (const message of report.issues.messages) {
    const problem = message.code === "IO_ERROR" ? problems(uris.get(message.pointer)) : undefined;
    if (problem !== undefined) message.message = problem;
  }
}

/** Validates, fetches what was missing, validates again. Near the limit of issues, resources are fetched one by
    one, because what the first one has may be the last that is looked at. */
async function validateWithResources(engine, bytes, options, load) {
  const resources = new Map();
  const problems = new Map();
  const written = new Map();
  for (let asked = 0; ; ) {
    const answer = await engine.validate(bytes, { ...options, profile: "khronos", resources });
    const report = JSON.parse(answer.report);
    for (const uri of answer.missing) written.set(normalizeUri(uri), [...(written.get(normalizeUri(uri)) ?? []), uri]);
    const uses = load ? usesIn(report, answer.missing) : [];
    const known = resources.size;
    const end = hasRoom(report, uses, options.maxIssues) ? uses.length : Math.min(asked + 1, uses.length);
    for (; asked < end; ++asked) {
      const uri = uses[asked];
      const { bytes: loaded, problem } = await ask(load, uri);
      if (problem === undefined && !isBytes(loaded)) {
        throw invalidArgument("Promise must be fulfilled with Uint8Array or rejected.");
      }
      if (problem !== undefined && !problems.has(uri)) problems.set(uri, problem);
      for (const name of written.get(uri) ?? []) if (!resources.has(name)) resources.set(name, loaded ?? null);
    }
    if (resources.size > known || asked < uses.length) continue;
    describeFailures(report, (uri) => (load ? problems.get(uri) : noFunction));
    return report;
  }
}

async function run(getEngine, bytes, engineOptions, reportOptions) {
  const engine = await getEngine();
  const report = await validateWithResources(engine, bytes, engineOptions, reportOptions.load).catch((error) => {
    throw error instanceof Error ? String(error) : error;
  });
  return {
    ...(reportOptions.uri === undefined ? {} : { uri: reportOptions.uri }),
    ...(report.mimeType === undefined ? {} : { mimeType: report.mimeType }),
    validatorVersion: packageVersion,
    ...(reportOptions.writeTimestamp ? { validatedAt: new Date().toISOString() } : {}),
    issues: report.issues,
    ...(report.info === undefined ? {} : { info: report.info }),
  };
}

function formatOf(bytes, format) {
  const name = format?.toLowerCase();
  if (name === "glb" || name === "gltf") return name;
  if (bytes[0] === 0x67) return "glb"; // "g"
  if ([0x7b, 0x20, 0x09, 0x0a, 0x0d, 0xef].includes(bytes[0])) return "gltf";
  throw "Invalid data: could not detect glTF format.";
}

export function createCompat(getEngine) {
  return {
    version: () => packageVersion,
    supportedExtensions: () => [...khronosExtensions],
    // What the caller changes after the call does not matter.
    async validateBytes(data, options) {
      checkData(data);
      checkIsObject(options);
      const engineOptions = checkEngineOptions(options);
      const format = formatOf(data, options?.format);
      const bytes = Uint8Array.prototype.slice.call(data);
      return run(getEngine, bytes, { ...engineOptions, format }, checkReportOptions(options));
    },
    async validateString(json, options) {
      if (typeof json !== "string") throw "Invalid argument(s): json: Argument must be a string.";
      checkIsObject(options);
      const engineOptions = checkEngineOptions(options);
      // A byte order mark belongs to bytes; in a string it is an unknown character.
      const bytes = utf8.encode(json.replace(/^\ufeff/, "\ufffd"));
      return run(getEngine, bytes, { ...engineOptions, format: "gltf" }, checkReportOptions(options));
    },
  };
}

// SPDX-License-Identifier: Apache-2.0
// Stands for tools/npm/engine.mjs: the native program (GLTFX_STAND_IN) in a folder of its own.
import { spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";

const program = process.env.GLTFX_STAND_IN;
const levels = ["error", "warning", "info", "hint"];

function start(args, cwd, stdin) {
  return new Promise((done, fail) => {
    const child = spawn(program, args, { cwd, stdio: "pipe" });
    const out = [],
      err = [];
    child.stdout.on("data", (part) => out.push(part));
    child.stderr.on("data", (part) => err.push(part));
    child.on("error", fail);
    child.stdin.on("error", () => {});
    child.on("close", (code) =>
      done({ code, stdout: Buffer.concat(out), stderr: Buffer.concat(err).toString() }),
    );
    child.stdin.end(stdin);
  });
}

let codes;
async function knownCodes() {
  codes ??= JSON.parse((await start(["rules", "--format", "json"])).stdout).rules.map(({ code }) => code);
  return codes;
}

function valueAt(document, pointer) {
  return pointer
    .split("/")
    .slice(1)
    .reduce((value, key) => value?.[key], document);
}

function writtenUris(bytes, resources) {
  const text = Buffer.from(bytes);
  const json = text[0] === 0x67 && text.length > 20 ? text.subarray(20, 20 + text.readUInt32LE(12)) : text;
  let document;
  try {
    document = JSON.parse(json.toString().replace(/^\ufeff/, ""));
  } catch {
    return [];
  }
  return resources
    .map(({ pointer }) => valueAt(document, pointer)?.uri)
    .filter((uri) => typeof uri === "string");
}

function place(folder, uri, bytes) {
  let path = uri.replaceAll("\\", "/");
  try {
    path = decodeURIComponent(path);
  } catch {
    // as it is
  }
  if (/^[a-z]+:/i.test(uri) || uri.startsWith("/") || /[?#\0]/.test(uri)) return;
  const file = resolve(folder, path);
  if (!file.startsWith(resolve(folder, "../../..")) || file === folder || path.endsWith("/")) return;
  try {
    mkdirSync(dirname(file), { recursive: true });
    writeFileSync(file, bytes);
  } catch {
    // a folder of that name is there
  }
}

async function wordsOf(options) {
  const known = await knownCodes();
  const words = ["--profile", options.profile ?? "default", "--isolated", "--fail-on", "never", "-j1"];
  const isKnown = (code) => known.includes(code);
  const only = (options.onlyIssues ?? []).filter(isKnown);
  if (only.length) words.push("--select", only.join());
  else if (options.onlyIssues?.length) words.push("--ignore", known.join());
  const ignored = (options.ignoredIssues ?? []).filter(isKnown);
  if (ignored.length) words.push("--ignore", ignored.join());
  for (const [code, level] of Object.entries(options.severityOverrides ?? {})) {
    if (isKnown(code)) words.push("--severity", `${code}=${levels[level]}`);
  }
  if (options.maxIssues) words.push("--max-issues", String(options.maxIssues));
  return words;
}

async function validate(bytes, options = {}) {
  const root = mkdtempSync(join(tmpdir(), "gltfx_stand_in_"));
  try {
    const folder = join(root, "a/b/c");
    mkdirSync(folder, { recursive: true });
    const given = options.resources ?? new Map();
    for (const [uri, data] of given) if (data !== null) place(folder, uri, data);
    const format = options.format ?? (bytes[0] === 0x67 ? "glb" : "gltf");
    const name = options.uri ?? `the-asset.${format}`;
    const file = join(folder, `the-asset.${format}`);
    writeFileSync(file, bytes);
    const khronos = join(root, "khronos.json"),
      own = join(root, "own.json");
    const done = await start(
      [
        "validate",
        file,
        ...(await wordsOf(options)),
        "--root",
        root,
        `--format=khronos=${khronos}`,
        `--format=json=${own}`,
      ],
      root,
    );
    if (done.code !== 0) throw new Error(`gltfx ended with ${done.code}: ${done.stderr}`);
    const report = JSON.parse(readFileSync(khronos));
    const external = (report.info?.resources ?? []).filter(({ storage }) => storage === "external");
    const missing = writtenUris(bytes, external).filter((uri) => !given.has(uri));
    const isKhronos = options.profile === "khronos";
    const text = readFileSync(isKhronos ? khronos : own, "utf8").replaceAll(
      JSON.stringify(file),
      JSON.stringify(name),
    );
    return { report: text, missing };
  } finally {
    rmSync(root, { recursive: true, force: true });
  }
}

function snapshot(folder, found = new Map()) {
  for (const name of readdirSync(folder)) {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) snapshot(path, found);
    else found.set(path, readFileSync(path));
  }
  return found;
}

async function run(args, files = new Map(), { cwd = "/work", stdin } = {}) {
  const root = mkdtempSync(join(tmpdir(), "gltfx_stand_in_"));
  try {
    const folder = join(root, cwd);
    mkdirSync(folder, { recursive: true });
    const placed = (path) => (path.startsWith("/") ? join(root, path) : join(folder, path));
    for (const [path, bytes] of files) {
      mkdirSync(path.endsWith("/") ? placed(path) : dirname(placed(path)), { recursive: true });
      if (!path.endsWith("/")) writeFileSync(placed(path), bytes);
    }
    const before = snapshot(root);
    const inside = args.map((word) => word.replace(/(^|=)\//, `$1${root}/`));
    const done = await start(inside, folder, stdin);
    const changed = new Map();
    for (const [path, bytes] of snapshot(root)) {
      if (before.get(path)?.equals(bytes)) continue;
      const inFolder = path.startsWith(folder + "/");
      changed.set(inFolder ? path.slice(folder.length + 1) : path.slice(root.length), bytes);
    }
    const stdout = Buffer.from(done.stdout.toString("latin1").replaceAll(root, ""), "latin1");
    return { code: done.code, stdout, stderr: done.stderr.replaceAll(root, ""), files: changed };
  } finally {
    rmSync(root, { recursive: true, force: true });
  }
}

export async function createEngine() {
  const version = (await start(["--version"])).stdout.toString().split(/\s+/)[1];
  return { version, validate, run };
}

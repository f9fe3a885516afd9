// SPDX-License-Identifier: Apache-2.0
// References of assets and paths of command lines: the npm command refuses those that the native program refuses, with
// the same messages, and the functions of the package do not request them.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { join, posix } from "node:path";
import { test } from "node:test";
import { assetWith, HOSTILE_URIS, makeHostileFolder, makeHuge, SECRET } from "./hostile_paths.mjs";
import { command, importFrom, install, temporaryFolder } from "./packages.mjs";

const native = install({ native: true });
const engine = install({ native: false });
const place = temporaryFolder();
const folder = makeHostileFolder(place);
const HANGS = 120000; // milliseconds: what takes longer waits for a pipe, or reads without end

function same(args, options = {}) {
  const [expected, found] = [native, engine].map((one) =>
    command(one, args, { cwd: folder, timeout: HANGS, ...options }),
  );
  assert.notEqual(expected.code, null, args.join(" "));
  // Each C library has its own messages.
  expected.stdout = expected.stdout.replaceAll("Too many levels of symbolic links", "Symbolic link loop");
  assert.deepEqual(found, expected);
  assert.ok(!found.stdout.includes(SECRET));
  return found;
}

for (const [at, [uri]] of HOSTILE_URIS.entries()) {
  test(`the command and ${uri}`, () => {
    writeFileSync(join(folder, `${at}.gltf`), assetWith(uri));
    const { files } = JSON.parse(same(["validate", `${at}.gltf`, "--format", "json"]).stdout);
    const bad = files[0].findings.filter(({ severity }) => severity === "error" || severity === "warning");
    assert.ok(bad.length > 0);
    same(["inspect", `${at}.gltf`]);
  });
}

test("a root lets links lead to it, and no further", () => {
  for (const [uri, readable] of [
    ["up.bin", true],
    ["../secret.bin", true],
    ["above/secret.bin", true],
    ["../../secret.bin", false],
    ["zero.bin", false],
    ["pipe.bin", false],
  ]) {
    writeFileSync(join(folder, "rooted.gltf"), assetWith(uri));
    const { stdout } = same(["validate", "rooted.gltf", "--root", "..", "--format", "json"]);
    const codes = JSON.parse(stdout).files[0].findings.map(({ code }) => code);
    const refused = ["URI_OUTSIDE_ROOT", "RESOURCE_NOT_A_FILE", "IO_ERROR"];
    assert.equal(!codes.some((code) => refused.includes(code)), readable, `${uri}: ${codes}`);
  }
});

test("the functions ask for paths below the asset alone", async () => {
  const { inspect, upgrade, validate } = await importFrom(engine, "gltfx/index.mjs");
  for (const [uri, needsDisk] of HOSTILE_URIS) {
    const asked = [];
    const resources = (path) => {
      asked.push(path);
      return new Uint8Array(4);
    };
    const bytes = Buffer.from(assetWith(uri));
    const { findings } = await validate(bytes, { resources });
    await upgrade(bytes, { resources });
    await inspect(bytes, { resources });
    assert.deepEqual([...new Set(asked)], needsDisk ? [posix.normalize(uri)] : [], uri);
    // Readers may fetch from a server: that such a file is not read is a warning.
    const [code, severity] = uri.startsWith("http:") ? ["NON_RELATIVE_URI", "warning"] : [null, "error"];
    const isRefused = (one) => one.severity === severity && (code === null || one.code === code);
    if (!needsDisk) assert.ok(findings.some(isRefused), uri);
  }
});

// Named by the user, found in a folder, or named by a configuration.
const COMMANDS = [
  ["validate", "pipe.gltf"],
  ["validate", "/dev/zero"],
  ["validate", "folder.gltf"],
  ["validate", "zero.gltf"],
  ["validate", "."],
  ["validate", "linked"],
  ["validate", "*.gltf"],
  ["validate", "asset.gltf", "--baseline", "pipe.gltf"],
  ["validate", "asset.gltf", "--schema", "/dev/zero"],
  ["validate", "asset.gltf", "--config", "pipe.gltf"],
  ["validate", "asset.gltf", "--config", "hostile.toml"],
  ["validate", "--files-from", "pipe.gltf"],
  ["validate", "--files-from", "/dev/zero"],
  ["validate", "configured"],
  ["validate", "ignoring"],
  ["upgrade", ".", "--in-place"],
];

function project() {
  const made = mkdtempSync(join(place, "project_"));
  for (const name of ["folder.gltf", "linked", "configured", "ignoring", "outside"]) mkdirSync(join(made, name));
  for (const name of ["asset.gltf", "configured/a.gltf", "ignoring/a.gltf", "outside/b.gltf"])
    writeFileSync(join(made, name), '{"asset": {"version": "2.0"}}');
  for (const name of ["pipe.gltf", "configured/gltfx.toml", "ignoring/.gitignore"])
    execFileSync("mkfifo", [join(made, name)]);
  mkdirSync(join(made, "ignoring/.git"));
  symlinkSync("/dev/zero", join(made, "zero.gltf"));
  symlinkSync("../outside", join(made, "linked/folder"));
  symlinkSync("../outside/b.gltf", join(made, "linked/b.gltf"));
  symlinkSync(".", join(made, "linked/again"));
  writeFileSync(join(made, "hostile.toml"), 'baseline = "/dev/zero"\nschemas = ["/dev/zero"]\n');
  return made;
}

for (const args of COMMANDS) {
  test(`the command line ${args.join(" ")}`, () => {
    const [expected, found] = [native, engine].map((one) => {
      const cwd = project();
      const { code, stdout, stderr } = command(one, args, { cwd, timeout: HANGS });
      return { code, stdout: stdout.replaceAll(cwd, "CWD"), stderr: stderr.replaceAll(cwd, "CWD") };
    });
    assert.notEqual(expected.code, null);
    assert.deepEqual(found, expected);
  });
}

test("a file that is larger than the memory of the engine", () => {
  writeFileSync(join(folder, "huge.gltf"), assetWith("huge.bin"));
  makeHuge(join(folder, "huge.bin"), 5 * 2 ** 30);
  const { code, stdout } = command(engine, ["validate", "huge.gltf"], { cwd: folder, timeout: HANGS });
  assert.equal(code, 1);
  assert.match(stdout, /'huge\.bin' is too large/);
  makeHuge(join(folder, "huge.glb"), 5 * 2 ** 30);
  const asset = command(engine, ["validate", "huge.glb"], { cwd: folder, timeout: HANGS });
  assert.equal(asset.code, 3); // an input cannot be read
  assert.match(asset.stdout, /'huge\.glb' is too large/);
});

test("files are written as the program writes them: whole, by their owner's rules", () => {
  const results = [native, engine].map((one) => {
    const cwd = mkdtempSync(join(place, "written_"));
    cpSync(new URL("../../fixtures/legacy/awning.gltf", import.meta.url).pathname, join(cwd, "a.gltf"));
    symlinkSync("a.gltf", join(cwd, "link.gltf"));
    const done = command(one, ["upgrade", "link.gltf", "--in-place"], { cwd });
    const names = execFileSync("ls", ["-A", "--file-type", cwd]).toString();
    return { ...done, names, bytes: readFileSync(join(cwd, "a.gltf"), "utf8") };
  });
  assert.deepEqual(results[1], results[0]);
  assert.match(results[0].bytes, /KHR_materials_diffuse_transmission/);
});

// SPDX-License-Identifier: Apache-2.0
// Parts of the package that need no engine.
import assert from "node:assert/strict";
import nodePath from "node:path";
import { test } from "node:test";
import { createApi } from "../../tools/npm/lib/api.mjs";
import { checkAreCodes, checkOptions } from "../../tools/npm/lib/api_options.mjs";
import { hostPath, virtualPath, virtualWord } from "../../tools/npm/lib/paths.mjs";
import { normalizeUri } from "../../tools/npm/lib/uri.mjs";

test("paths of Windows", () => {
  const { win32 } = nodePath;
  const exists = (path) => path === "C:\\here\\a\\b.gltf" || path === "C:\\here\\a";
  const word = (text) => virtualWord(text, "C:\\here", win32, exists);
  assert.equal(virtualPath("C:\\here\\a", win32), "/C:/here/a");
  assert.equal(word("a\\b.gltf"), "a/b.gltf");
  assert.equal(word("C:\\here\\a\\b.gltf"), "/C:/here/a/b.gltf");
  assert.equal(word("--format=json=C:\\new.json"), "--format=json=/C:/new.json");
  assert.equal(word("--ignore=A\\B"), "--ignore=A\\B");
  assert.equal(hostPath("/C:/here/a", win32), "C:\\here\\a");
  assert.equal(hostPath("/C:", win32), "C:\\");
  for (const path of ["/", "/server/share/x", "/CON", "/C"]) assert.equal(hostPath(path, win32), null, path);
});

test("paths of other systems stay as they are", () => {
  const { posix } = nodePath;
  for (const path of ["/a/b", "a\\b", "C:/a"]) {
    assert.equal(virtualPath(path, posix), path);
    assert.equal(hostPath(path, posix), path);
    assert.equal(virtualWord(path, "/here", posix), path);
  }
});

// Verb -> refused options.
const WRONG = {
  validate: [
    { onlyIssues: "x" },
    { onlyIssues: [""] },
    { ignoredIssues: [1] },
    { onlyIssues: [], ignoredIssues: [] },
    { severityOverrides: [] },
    { severityOverrides: { IO_ERROR: 4 } },
    { severityOverrides: { IO_ERROR: "error" } },
    { maxIssues: -1 },
    { maxIssues: 0.5 },
    { maxIssues: "3" },
    { profile: "Khronos" },
    { profile: "" },
    { format: "GLB" },
    { uri: 1 },
    { resources: "." },
    { resources: {} },
    { externalResourceFunction: () => null },
    { maxissues: 1 },
    { toString: 1 },
    [],
    null,
    "x",
  ],
  upgrade: [{ only: "KHR" }, { to: [1] }, { only: [""] }, { unsafe: "no" }, { strict: 1 }, { profile: "strict" }],
  compare: [{ bounds: 1 }, { drawn: "yes" }, { ignore: "node.moved" }, { oldResources: 1 }, { resources: "." }],
  inspect: [{ resources: 1 }, { unsafe: true }],
};

test("wrong options are refused", () => {
  const bytes = new Uint8Array(1);
  for (const [verb, all] of Object.entries(WRONG)) {
    for (const options of all) {
      const refusal = { name: "TypeError", message: /^gltfx: / };
      assert.throws(() => checkOptions(verb, bytes, options), refusal, `${verb} ${JSON.stringify(options)}`);
    }
    for (const asset of ["text", [1], new Uint16Array(1), null])
      assert.throws(() => checkOptions(verb, asset, {}), TypeError);
    checkOptions(verb, bytes, { resources: undefined });
    checkOptions(verb, bytes, { resources: new Map() });
  }
});

test("right options come through; what is null is as if it were not there", () => {
  const right = { uri: "a", format: "glb", profile: "strict", onlyIssues: ["A"], ignoredIssues: null };
  assert.deepEqual(checkOptions("validate", new Uint8Array(1), right), {
    uri: "a",
    format: "glb",
    profile: "strict",
    maxIssues: 0,
    onlyIssues: ["A"],
    ignoredIssues: [],
    severityOverrides: {},
  });
  assert.deepEqual(checkOptions("upgrade", new Uint8Array(1), { only: ["A"], unsafe: false, to: null }), {
    only: ["A"],
    unsafe: false,
  });
});

test("codes that no rule has are refused", () => {
  const engine = { isCode: (code) => code === "A" };
  const none = { ignoredIssues: [], onlyIssues: [], severityOverrides: {} };
  checkAreCodes(engine, { ignoredIssues: ["A"], onlyIssues: ["A"], severityOverrides: { A: 1 } });
  for (const wrong of [{ ignoredIssues: ["B"] }, { onlyIssues: ["A", "B"] }, { severityOverrides: { B: 1 } }])
    assert.throws(() => checkAreCodes(engine, { ...none, ...wrong }), { message: "gltfx: there is no code 'B'" });
});

// Requests the paths that a text names, and reports those that it got.
function fakeEngine(more = {}) {
  const utf8 = new TextEncoder();
  const engine = {
    isReady: true,
    runs: [],
    isCode: (code) => code === "A",
    validate(asset, { paths, resources }) {
      assert.equal(paths, true);
      const wanted = new TextDecoder().decode(asset).split(",");
      const got = wanted.filter((path) => resources.get(path));
      return { report: JSON.stringify({ files: [{ got }] }), missing: wanted.filter((path) => !resources.has(path)) };
    },
    async run(words, files) {
      engine.runs.push([words.join(" "), [...files.keys()].sort()]);
      const one = { problem: "none", facts: { version: "2.0" } };
      const stdout = utf8.encode(JSON.stringify({ files: [one], assets: [one], ...more }));
      const written = ["asset.gltf", "x.png"].map((name) => [name, utf8.encode("new")]);
      return { code: 0, stdout, stderr: "", files: new Map(written) };
    },
  };
  return engine;
}

test("resources are asked for by path, once, and what is not there is reported", async () => {
  const { validate } = createApi(async () => fakeEngine());
  const asset = new TextEncoder().encode("my data.bin,sub/a#b.bin,C:/Windows/win.ini,gone.bin,my data.bin");
  const bytes = new Uint8Array(4);
  const there = new Map([
    ["my data.bin", bytes],
    ["sub/a#b.bin", bytes],
    ["C:/Windows/win.ini", null],
  ]);
  const missing = () => {
    throw new Error("ENOENT");
  };
  for (const answer of [
    (path) => there.get(path),
    async (path) => there.get(path) ?? null,
    (path) => there.get(path) ?? missing(),
    async (path) => there.get(path) ?? missing(),
  ]) {
    const asked = [];
    const resources = (path) => {
      asked.push(path);
      return answer(path);
    };
    assert.deepEqual(await validate(asset, { resources }), { got: ["my data.bin", "sub/a#b.bin", "my data.bin"] });
    assert.deepEqual(asked, ["my data.bin", "sub/a#b.bin", "gone.bin"]); // not a drive of Windows
  }
  assert.deepEqual(await validate(asset, { resources: there }), { got: ["my data.bin", "sub/a#b.bin", "my data.bin"] });
  assert.deepEqual(await validate(asset), { got: [] });
  await assert.rejects(validate(asset, { resources: () => "text" }), TypeError);
});

test("verbs get the files by the same paths, and options become words", async () => {
  const engine = fakeEngine();
  const { convert, edit, fix, inspect, upgrade } = createApi(async () => engine);
  const asset = new TextEncoder().encode("sub/a b.bin,gone.bin");
  const resources = new Map([["sub/a b.bin", new Uint8Array(4)]]);
  const done = await upgrade(asset, { resources, unsafe: true, only: ["X"], to: ["Y", "Z"] });
  assert.equal(new TextDecoder().decode(done.asset), "new");
  assert.deepEqual([...done.files.keys()], ["x.png"]);
  assert.deepEqual(await inspect(asset, { resources }), { version: "2.0" });
  await fix(asset, { resources, profile: "strict", unsafe: true, only: ["A"], skip: ["B", "C"] });
  await edit(asset, { resources, delete: ["/meshes/0", "/nodes/1"], cascade: true });
  await assert.rejects(edit(asset, { resources }), { name: "TypeError", message: /options.delete must name at least one object/ });
  await assert.rejects(edit(asset, { delete: "/meshes/0" }), TypeError);
  await assert.rejects(fix(asset, { only: "A" }), TypeError);
  await convert(asset, { resources, to: "glb", compress: "meshopt", dedup: true, shrink: true });
  await convert(asset, { resources });
  await assert.rejects(convert(asset, { compress: "draco" }), TypeError);
  const got = ["asset.gltf", "sub/a b.bin"];
  const head = "asset.gltf --isolated --format json";
  assert.deepEqual(engine.runs, [
    [`upgrade ${head} --in-place --unsafe --only X --to Y --to Z`, got],
    [`inspect ${head} --top 0`, got],
    [`fix ${head} --in-place --unsafe --profile strict --only A --skip B --skip C`, got],
    [`edit ${head} --in-place --cascade --delete /meshes/0 --delete /nodes/1`, got],
    [`convert ${head} -o out/asset.glb --dedup --shrink --to glb --compress meshopt`, got],
    [`convert ${head} -o out/asset.gltf`, got],
  ]);
});

test("two assets are compared with the files of each", async () => {
  const pair = { old: "old/asset.gltf", new: "new/asset.gltf", level: "storage", changes: [], storage: ["x"], unproven: [] };
  const engine = fakeEngine({ pairs: [pair] });
  const { compare } = createApi(async () => engine);
  const before = new TextEncoder().encode("a.bin");
  const after = new TextEncoder().encode("b/c.bin,gone.bin");
  const options = { oldResources: () => new Uint8Array(1), newResources: new Map([["b/c.bin", new Uint8Array(2)]]) };
  const found = await compare(before, after, { ...options, drawn: true, bounds: "normal=2deg", ignore: ["extras"] });
  assert.deepEqual(found, { level: "storage", changes: [], storage: ["x"], unproven: [] });
  assert.deepEqual(engine.runs, [
    [
      "compare old/asset.gltf new/asset.gltf --isolated --format json --drawn --bounds=normal=2deg --ignore extras",
      ["new/asset.gltf", "new/b/c.bin", "old/a.bin", "old/asset.gltf"],
    ],
  ]);
  await assert.rejects(compare(before, "text"), TypeError);
  await assert.rejects(compare("text", after), TypeError);
  const { compare: failing } = createApi(async () => fakeEngine({ pairs: [{ error: "old/asset.gltf: no" }] }));
  await assert.rejects(failing(before, after), /old\/asset\.gltf: no/);
});

test("URIs in the form of the Khronos validator", () => {
  for (const [uri, normal] of [
    ["a b", "a%20b"],
    ["a\\b", "a/b"],
    ["./a/../b", "b"],
    ["../../b", "../../b"],
    ["HTTP://Host/%7e", "http://host/~"],
  ])
    assert.equal(normalizeUri(uri), normal);
  assert.throws(() => normalizeUri(":a"), SyntaxError);
});

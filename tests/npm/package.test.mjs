// SPDX-License-Identifier: Apache-2.0
// The package as its users have it: modules, CommonJS, types, the entry of browsers.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { importFrom, install, modules, requireFrom, root, version } from "./packages.mjs";

const folder = install({ native: false });
const installed = join(folder, "node_modules/gltfx");
const fixture = (name) => new Uint8Array(readFileSync(join(root, "fixtures", name)));
const besides = (place) => (path) => readFile(join(root, "fixtures", place, path));
const readFile = async (path) => new Uint8Array(readFileSync(path));

test("the archive has no dependency, no script, the version of the project", () => {
  const description = JSON.parse(readFileSync(join(installed, "package.json")));
  assert.equal(description.version, version);
  assert.deepEqual(description.optionalDependencies, { "@gltfx/linux-x64": version });
  assert.deepEqual([description.dependencies, description.scripts], [undefined, undefined]);
  assert.ok(existsSync(join(installed, "LICENSE")));
  const licences = readFileSync(join(installed, "THIRD_PARTY.txt"), "utf8");
  for (const [, component] of readFileSync(join(installed, "sbom.spdx"), "utf8").matchAll(/^PackageName: (.*)$/gm))
    assert.ok(component === "gltfx" || licences.includes(`\n${component} `), component);
});

test("the engine is at most 1.7 MB, compressed with gzip", () => {
  const { length } = gzipSync(readFileSync(join(installed, "wasm/gltfx.wasm")), { level: 9 });
  assert.ok(length <= 1.7e6, `${length} bytes`);
});

const users = {
  module: ["user.mjs", 'import * as g from "gltfx"; import * as c from "gltfx/compat";'],
  CommonJS: ["user.cjs", 'const g = require("gltfx"); const c = require("gltfx/compat");'],
};
for (const [name, [file, head]] of Object.entries(users)) {
  test(`${name}: all functions`, () => {
    writeFileSync(
      join(folder, file),
      `${head}
      const bytes = new TextEncoder().encode('{"asset":{"version":"2.0"},"scene":1}');
      (async () => {
        const found = [await g.validate(bytes), await c.validateBytes(bytes), await g.validateBytes(bytes)];
        const facts = await g.inspect(bytes), upgraded = await g.upgrade(bytes), fixed = await g.fix(bytes);
        console.log(JSON.stringify([found[0].counts.errors, found[0].findings[0].code,
          found[1].issues.messages[0].code, found[2].issues.numErrors, facts.version,
          upgraded.asset.length, fixed.asset.length]));
      })();`,
    );
    const printed = execFileSync("node", [file], { cwd: folder });
    assert.deepEqual(JSON.parse(printed), [1, "UNRESOLVED_REFERENCE", "UNRESOLVED_REFERENCE", 1, "2.0", 37, 37]);
  });
}

test("validate: resources, profiles, misuse", async () => {
  const { validate } = await importFrom(folder, "gltfx/index.mjs");
  const leaf = fixture("good/leaf.gltf");
  assert.equal((await validate(leaf, { resources: besides("good") })).counts.errors, 0);
  assert.ok((await validate(leaf)).findings.some(({ code }) => code === "IO_ERROR"));
  assert.ok(
    (await validate(leaf, { resources: new Map() })).findings.some(({ code }) => code === "IO_ERROR"),
  );
  assert.equal((await validate(leaf, { profile: "khronos" })).mimeType, "model/gltf+json");
  assert.equal(
    (await validate(leaf, { onlyIssues: ["IO_ERROR"], severityOverrides: { IO_ERROR: 3 } })).counts.errors,
    0,
  );
  await assert.rejects(validate("leaf.gltf"), TypeError);
  await assert.rejects(validate(leaf, null), TypeError);
  await assert.rejects(validate(leaf, { resources: () => "text" }), TypeError);
});

test("text in Shift-JIS is read as by the native program", async () => {
  const { validate } = await importFrom(folder, "gltfx/index.mjs");
  const name = Buffer.from("8365835883678160b1", "hex");
  const bytes = Buffer.concat([Buffer.from('{"asset":{"version":"2.0","generator":"'), name, Buffer.from('"}}')]);
  const { findings } = await validate(bytes);
  const [{ message }] = findings.filter(({ code }) => code === "JSON_INVALID_UTF8");
  assert.ok(message.includes("read as Shift-JIS, it is '\u30c6\u30b9\u30c8\uff5e\uff71'"), message);
});

test("resources are asked for by decoded paths, as a function or as a Map", async () => {
  const { inspect, upgrade, validate } = await importFrom(folder, "gltfx/index.mjs");
  const bytes = new Uint8Array(4);
  for (const [uri, path] of [
    ["my%20data.bin", "my data.bin"],
    ["my data.bin", "my data.bin"],
    ["sub/./%C3%A4.bin", "sub/\u00e4.bin"],
    ["a%23b%3F.bin", "a#b?.bin"],
    ["100%25.bin", "100%.bin"],
  ]) {
    const asset = Buffer.from(JSON.stringify({ asset: { version: "2.0" }, buffers: [{ uri, byteLength: 4 }] }));
    const asked = [];
    const sources = [
      new Map([[path, bytes]]),
      async (name) => (asked.push(name), bytes),
      (name) => {
        if (name !== path) throw new Error("ENOENT");
        return bytes;
      },
    ];
    for (const resources of sources) {
      const { findings } = await validate(asset, { resources });
      assert.ok(!findings.some(({ code }) => code === "IO_ERROR"), uri);
      assert.equal((await inspect(asset, { resources })).problems.length, 0);
      await upgrade(asset, { resources });
    }
    assert.deepEqual([...new Set(asked)], [path]);
    const { findings } = await validate(asset, { resources: () => { throw new Error("ENOENT"); } });
    assert.ok(findings.some(({ code }) => code === "IO_ERROR"), uri);
  }
});

test("wrong options are refused, and the engine lives on", async () => {
  const gltfx = await importFrom(folder, "gltfx/index.mjs");
  const bytes = fixture("good/bowl.glb");
  const refusal = { name: "TypeError", message: /^gltfx: / };
  for (const options of [
    { profile: "Khronos" },
    { onlyIssues: "x" },
    { onlyIssues: ["NO_SUCH_CODE"] },
    { ignoredIssues: ["io_error"] },
    { severityOverrides: { NO_SUCH_CODE: 1 } },
    { maxIssues: -1 },
    { resources: "." },
  ])
    await assert.rejects(gltfx.validate(bytes, options), refusal, JSON.stringify(options));
  await assert.rejects(gltfx.upgrade(bytes, { only: "KHR_materials_unlit" }), refusal);
  await assert.rejects(gltfx.inspect(bytes, { unsafe: true }), refusal);
  const right = { uri: "a", format: "glb", profile: "strict", maxIssues: 1, onlyIssues: ["IO_ERROR"] };
  assert.equal((await gltfx.validate(bytes, right)).counts.errors, 0);
});

test("the example of the page", () => {
  const page = readFileSync(join(root, "docs/npm.md"), "utf8");
  const [, code] = /```js\n([^]*?)```/.exec(page);
  const place = join(folder, "example");
  mkdirSync(place);
  const buffers = [{ uri: "my%20data.bin", byteLength: 4 }];
  writeFileSync(join(place, "model.gltf"), JSON.stringify({ asset: { version: "2.0" }, buffers }));
  writeFileSync(join(place, "my data.bin"), "1234");
  const print = "console.log(counts.errors, findings.length > 0, asset.length > 0, files.size, facts.version)";
  writeFileSync(join(place, "example.mjs"), code + print);
  assert.equal(`${execFileSync("node", ["example.mjs"], { cwd: place })}`, "0 true true 0 2.0\n");
});

test("upgrade and inspect: the asset of before is left alone, the new one is upgraded", async () => {
  const { inspect, upgrade } = await importFrom(folder, "gltfx/index.mjs");
  const awning = fixture("legacy/awning.gltf"),
    before = awning.slice();
  const { asset, report } = await upgrade(awning, { resources: besides("legacy") });
  assert.deepEqual(awning, before);
  assert.equal(report.actions[0].to, "KHR_materials_diffuse_transmission");
  const names = ({ extensions }) => extensions.map(({ name }) => name);
  assert.ok(
    names(await inspect(awning, { resources: besides("legacy") })).includes("KHR_materials_translucency"),
  );
  assert.ok(!names(await inspect(asset)).includes("KHR_materials_translucency"));
  await assert.rejects(inspect(new Uint8Array(4)), Error);
  await assert.rejects(upgrade(new Uint8Array(4)), Error);
});

test("fix and edit: new bytes, and what became of each finding and object", async () => {
  const { edit, fix, validate } = await importFrom(folder, "gltfx/index.mjs");
  const text =
    '{"asset": {"version": "2.0"}, "scenes": [{"nodes": ["0", "1"]}], "nodes": [{"extras": {}}, {"extras": {}}]}';
  const before = new TextEncoder().encode(text);
  const fixed = await fix(before);
  assert.equal(new TextDecoder().decode(fixed.asset), text.replace('"0", "1"', "0, 1"));
  const pointers = ["/scenes/0/nodes/0", "/scenes/0/nodes/1"];
  assert.deepEqual(fixed.report.actions, [{ code: "INVALID_INDEX", fix: "safe", count: 2, pointers, done: true }]);
  assert.equal(new TextDecoder().decode(before), text);
  assert.equal((await validate(fixed.asset)).counts.errors, 0);
  const left = await fix(before, { skip: ["INVALID_INDEX"] });
  assert.deepEqual([left.report.changes, left.asset], [false, before]);

  const refused = await edit(fixed.asset, { delete: ["/nodes/1"] });
  assert.equal(refused.report.problem, "refused");
  assert.equal(refused.report.obstacles[0].pointer, "/scenes/0/nodes/1");
  assert.deepEqual(refused.asset, fixed.asset);
  const { asset, report } = await edit(fixed.asset, { delete: ["/nodes/1"], cascade: true });
  const { nodes, scenes } = JSON.parse(new TextDecoder().decode(asset));
  assert.deepEqual([nodes, scenes], [[{ extras: {} }], [{ nodes: [0] }]]);
  assert.deepEqual(report.deleted, [{ pointer: "/nodes/1" }, { pointer: "/scenes/0/nodes/1", cause: "/nodes/1" }]);
  await assert.rejects(fix(new Uint8Array(4)), Error);
});

test("convert: one GLB, and files beside a .gltf again", async () => {
  const { convert } = await importFrom(folder, "gltfx/index.mjs");
  const text = '{"asset": {"version": "2.0"}, "buffers": [{"uri": "a b.bin", "byteLength": 4}]}';
  const resources = new Map([["a b.bin", new TextEncoder().encode("abcd")]]);
  const packed = await convert(new TextEncoder().encode(text), { resources, to: "glb" });
  assert.deepEqual([packed.report.steps[0].step, packed.files.size], ["container", 0]);
  assert.equal(new TextDecoder().decode(packed.asset.slice(0, 4)), "glTF");
  const back = await convert(packed.asset, { to: "gltf" });
  assert.deepEqual(back.report.newFiles, ["asset.bin"]);
  assert.equal(new TextDecoder().decode(back.files.get("asset.bin")), "abcd");
  assert.equal(JSON.parse(new TextDecoder().decode(back.asset)).buffers[0].uri, "asset.bin");
  const refused = await convert(new TextEncoder().encode(text), { to: "glb" });
  assert.equal(refused.report.problem, "refused");
});

// Modules that are reachable from a file, with their imports that are not files.
function reachable(file, found = new Map()) {
  if (found.has(file)) return found;
  const text = readFileSync(file, "utf8");
  const named = [...text.matchAll(/(?:from|import\()\s*["']([^"']+)["']/g)].map(([, name]) => name);
  found.set(
    file,
    named.filter((name) => !name.startsWith(".")),
  );
  for (const name of named) if (name.startsWith(".")) reachable(resolve(dirname(file), name), found);
  return found;
}

test("nothing of Node.js is reachable from the entries of browsers", () => {
  for (const entry of ["browser.mjs", "compat-browser.mjs"]) {
    const all = [...reachable(join(installed, entry))];
    assert.ok(all.length >= 5);
    for (const [file, names] of all) if (!file.endsWith("gltfx-wasm.mjs")) assert.deepEqual(names, [], file);
  }
  const nodeEntry = [...reachable(join(installed, "index.mjs")).values()].flat();
  assert.ok(nodeEntry.some((name) => name.startsWith("node:")));
});

test("the entry of browsers fetches the engine, and again after a failure", async () => {
  let failures = 1;
  globalThis.fetch = async (url) =>
    failures-- > 0 ? new Response("", { status: 503 }) : new Response(readFileSync(url));
  const { validate, validateString } = await importFrom(folder, "gltfx/browser.mjs");
  await assert.rejects(validate(new Uint8Array(1)), /503/);
  assert.equal((await validate(fixture("good/bowl.glb"))).counts.errors, 0);
  assert.equal((await validateString("{}")).issues.numErrors, 1);
});

test("a bundle of esbuild, with the engine beside it", async (t) => {
  const esbuild = join(modules, ".bin/esbuild");
  if (!existsSync(esbuild)) return t.skip("esbuild is not installed");
  writeFileSync(
    join(folder, "page.mjs"),
    `import { upgrade, validate } from "gltfx";
    import { validateString } from "gltfx/compat";
    export { upgrade, validate, validateString };`,
  );
  const words = ["page.mjs", "--bundle", "--minify", "--format=esm", "--outfile=bundled/page.mjs"];
  const done = spawnSync(esbuild, [...words, "--log-level=warning"], { cwd: folder });
  assert.equal(`${done.status} ${done.stderr}`, "0 ");
  copyFileSync(join(installed, "wasm/gltfx.wasm"), join(folder, "bundled/gltfx.wasm"));
  rmSync(join(folder, "page.mjs"));
  globalThis.fetch = async (url) => new Response(readFileSync(url));
  const { upgrade, validate, validateString } = await import(pathToFileURL(join(folder, "bundled/page.mjs")));
  assert.equal((await validate(fixture("good/bowl.glb"))).counts.errors, 0);
  assert.equal((await validateString("{}")).issues.numErrors, 1);
  const { report } = await upgrade(fixture("legacy/awning.gltf"), { resources: besides("legacy") });
  assert.equal(report.actions[0].to, "KHR_materials_diffuse_transmission");
});

test("types", (t) => {
  const tsc = join(modules, ".bin/tsc");
  if (!existsSync(tsc)) return t.skip("typescript is not installed");
  writeFileSync(
    join(folder, "user.ts"),
    `
    import gltfx, { compare, convert, edit, fix, inspect, upgrade, validate, validateBytes } from "gltfx";
    import * as compat from "gltfx/compat";
    import validator from "gltfx/compat";
    async function run(bytes: Uint8Array): Promise<number> {
      const one = await validate(bytes, { profile: "khronos", resources: async (uri: string) => null });
      const two = await validate(bytes, { resources: new Map([["a", bytes]]) });
      const three = await compat.validateString("{}", { severityOverrides: { A: 3 } });
      await validateBytes(bytes, { externalResourceFunction: async () => bytes });
      const { asset, files } = await upgrade(bytes, { only: ["X"] });
      const count: number = (await fix(asset, { profile: "strict" })).report.actions[0].count;
      const cause: string | undefined = (await edit(asset, { delete: ["/a"] })).report.deleted[0].cause;
      const size: number = (await convert(asset, { to: "glb" })).report.steps[0].bytes_after;
      // @ts-expect-error it has no encoder of Draco
      await convert(asset, { compress: "draco" });
      const level: string = (await compare(bytes, asset, { drawn: true })).changes[0].measure?.unit ?? "";
      await inspect(asset);
      await gltfx.inspect(asset, { resources: (path) => bytes });
      const named: string = gltfx.version() + validator.version() + validator.supportedExtensions().length + level;
      const four = await validator.validateBytes(bytes, { uri: named });
      const five = await gltfx.validate(bytes, { profile: "khronos" });
      // @ts-expect-error it has no such function
      validator.inspect(asset);
      // @ts-expect-error text is not an asset
      await validate("model.gltf");
      // @ts-expect-error no such severity
      await compat.validateString("{}", { severityOverrides: { A: 4 } });
      const errors = two.counts.errors + four.issues.numErrors + five.issues.numErrors;
      return one.issues.numErrors + errors + three.issues.numHints + files.size + size;
    }
    export default run;`,
  );
  const words = [
    "--noEmit",
    "--strict",
    "--module",
    "nodenext",
    "--target",
    "es2022",
    "--types",
    "",
    "user.ts",
  ];
  const done = spawnSync(tsc, words, { cwd: folder });
  assert.equal(done.status, 0, `${done.stdout}`);
});

test("CommonJS answers what needs no engine at once", () => {
  assert.equal(requireFrom(folder)("gltfx").version(), version);
});

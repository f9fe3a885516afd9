// SPDX-License-Identifier: Apache-2.0
// Parts of the page that need no browser and no engine: contents of archives and of drops.
import assert from "node:assert/strict";
import { test } from "node:test";
import { isFixable, nameOfGlb, toUpgrade } from "../../tools/web/assets.mjs";
import { compareTexts } from "../../tools/web/comparison.mjs";
import { groupsOf, openFolder } from "../../tools/web/files.mjs";
import { fromDrop, titleOf } from "../../tools/web/dropped.mjs";
import { crc32, readZip, writeZip } from "../../tools/web/zip.mjs";
import { archive } from "./archives.mjs";

const GOOD = Buffer.from('{"asset": {"version": "2.0"}}');
const entry = (path, lies) => ({ path, bytes: GOOD, method: 0, ...lies });
const dropped = (path, bytes) => ({ path, file: new Blob([bytes]) });

test("separators of Windows and './' in archives are understood", async () => {
  const paths = ["a\\b.gltf", ".\\c.gltf", "./d/./e.gltf", "f\\", "./", "..g/h.gltf", "i..\\j.gltf"];
  const files = await readZip(new Blob([archive(paths.map((path) => entry(path)))]));
  const read = ["a/b.gltf", "c.gltf", "d/e.gltf", "..g/h.gltf", "i../j.gltf"];
  assert.deepEqual(files.map(({ path }) => path), read);
  assert.deepEqual(await files[0].read(), new Uint8Array(GOOD));
});

test("paths that lead out of an archive are left out, however they are written", async () => {
  const paths = ["../a.gltf", "..\\b.gltf", "./../c.gltf", ".\\..\\d.gltf", "/e.gltf", "\\f.gltf", "g/..\\..\\h.gltf"];
  const folder = await openFolder([dropped("x.zip", archive(paths.map((path) => entry(path))))]);
  assert.deepEqual(folder.assets, []);
  assert.equal(folder.leftOut.length, paths.length);
  for (const { why, mayHideAssets } of folder.leftOut)
    assert.deepEqual([why, mayHideAssets], ["its path could lead out of the folder", true]);
});

test("an archive that is refused says so", async () => {
  const whole = archive([entry("a.gltf")]);
  const bomb = archive([entry("a.gltf", { size: 300 << 20, method: 8 })]);
  const same = archive([entry("a.gltf"), entry("b.gltf", { same: true })]);
  for (const [name, bytes, why] of [
    ["a.zip", Buffer.from("PK, but no archive"), "it is not a whole zip archive"],
    ["b.zip", whole.subarray(0, whole.length - 3), "it is not a whole zip archive"],
    ["c.zip", bomb, "it unpacks to far more than it is"],
    ["d.zip", same, "files in it overlap"],
    ["e.7z", whole, "it is no .zip archive; unpack it first"],
    ["f.tar", whole, "it is no .zip archive; unpack it first"],
  ]) {
    const { assets, leftOut } = await openFolder([dropped(name, bytes)]);
    assert.deepEqual(assets, [], name);
    assert.deepEqual(leftOut, [{ path: name, why, isArchive: true, mayHideAssets: true }]);
  }
  for (const [lies, why] of [
    [{ flags: 0x801 }, "it is encrypted"],
    [{ method: 12 }, "it is packed by a method other than deflate"],
  ]) {
    const { leftOut } = await openFolder([dropped("g.zip", archive([entry("a.gltf", lies)]))]);
    assert.deepEqual(leftOut, [{ path: "g/a.gltf", why, mayHideAssets: true }]);
  }
});

test("what the browser does not hand over is named", async () => {
  const file = (name, of) => ({ name, isDirectory: false, file: of });
  const folder = (name, entries) => ({
    name,
    isDirectory: true,
    createReader: () => ({ readEntries: (done, failed) => (entries ? done(entries.splice(0)) : failed("no")) }),
  });
  const item = (one) => ({ kind: "file", webkitGetAsEntry: () => one });
  const inside = [file("a.gltf", (done) => done(new Blob([GOOD]))), file("b.bin", (_, failed) => failed("no"))];
  const all = await fromDrop({
    items: [item(folder("whole", inside)), item(folder("locked", null)), item(null)],
    files: [{ name: "whole" }, { name: "locked" }, { name: "odd.gltf" }],
  });
  const { assets, leftOut } = await openFolder(all);
  assert.deepEqual(assets, ["whole/a.gltf"]);
  assert.deepEqual(leftOut.map(({ path }) => path).sort(), ["locked", "odd.gltf", "whole/b.bin"]);
  for (const { why } of leftOut) assert.equal(why, "the browser cannot read it");
});

test("assets that share files are changed together, others apart", async () => {
  const naming = (...uris) => Buffer.from(JSON.stringify({ images: uris.map((uri) => ({ uri })) }));
  const { files, assets } = await openFolder([
    dropped("a.gltf", naming("own.png")),
    dropped("b.gltf", naming("x.png", "gone.png")),
    dropped("c.gltf", naming("gone.png", "sub/../y.png")),
    dropped("d.gltf", naming("%78.png", "y.png")),
    dropped("e.gltf", naming()),
    dropped("sub/f.gltf", naming("../e.gltf")),
    dropped("sub/g.gltf", naming("x.png")),
    ...["own.png", "x.png", "y.png", "sub/x.png"].map((path) => dropped(path, GOOD)),
  ]);
  const expected = [["a.gltf"], ["b.gltf", "c.gltf", "d.gltf"], ["e.gltf", "sub/f.gltf"], ["sub/g.gltf"]];
  assert.deepEqual(await groupsOf(files, assets), expected);
  assert.deepEqual(await groupsOf(files, ["b.gltf", "c.gltf"]), [["b.gltf"], ["c.gltf"]]);
  assert.deepEqual(await groupsOf(files, []), []);
});

test("what can be done with an asset", () => {
  const asset = { findings: [{}, { fixable: true }], upgrade: [{ done: false }, { done: true }] };
  assert.equal(isFixable(asset), true);
  assert.equal(toUpgrade(asset), 1);
  assert.equal(isFixable({ ...asset, findings: [{}] }), false);
  assert.equal(toUpgrade({ ...asset, upgrade: [] }), 0);
  const taken = new Map([["a.b/c.glb", 0]]);
  assert.equal(nameOfGlb("a.b/c.gltf", new Map()), "a.b/c.glb");
  assert.equal(nameOfGlb("a.b/c.glb", taken), "a.b/c-2.glb");
  assert.equal(nameOfGlb("a.b/c", taken), "a.b/c-2.glb");
});

test("an archive that is written is read again", async () => {
  const files = [
    ["a/b.gltf", new Uint8Array(GOOD)],
    ["\u00e4.bin", new Uint8Array(1000).fill(7)],
  ];
  const read = await readZip(writeZip(files));
  assert.deepEqual(await Promise.all(read.map(async (one) => [one.path, await one.read()])), files);
  assert.equal(crc32(new TextEncoder().encode("123456789")), 0xcbf43926);
  assert.equal(titleOf([{ path: "a/b" }, { path: "a/c" }]), "a");
});

test("two assets are compared with the files that they name", async () => {
  const named = Buffer.from('{"asset": {"version": "2.0"}, "buffers": [{"uri": "b.bin", "byteLength": 4}]}');
  const folder = await openFolder([dropped("-a.gltf", named), dropped("z.gltf", GOOD), dropped("b.bin", Buffer.alloc(4))]);
  const runs = [];
  const answer = { code: 1, stdout: new TextEncoder().encode("differs"), stderr: "" };
  const engine = {
    run: async (words, content) => {
      runs.push([words.slice(-3), [...content.keys()].sort()]);
      return answer;
    },
  };
  assert.equal(await compareTexts(engine, folder.files, folder.assets), "differs");
  assert.deepEqual(runs, [[["--", "-a.gltf", "z.gltf"], ["-a.gltf", "b.bin", "z.gltf"]]]);
  Object.assign(answer, { code: 3, stderr: "gltfx: z.gltf: no\n" });
  await assert.rejects(compareTexts(engine, folder.files, folder.assets), { message: "gltfx: z.gltf: no" });
});

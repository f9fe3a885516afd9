// SPDX-License-Identifier: Apache-2.0
// The page shows and offers what the native program prints and writes.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { archive } from "./archives.mjs";
import { choose, chooseFolder, download, drop, ended, open, unfold } from "./browsers.mjs";

const SEVERITIES = ["error", "warning", "info", "hint"];
const FILES = [
  "tour/lamp.gltf",
  "tour/quad.bin",
  "tour/shade.png",
  "good/tumbler.glb",
  "bad/leaf-unlit.gltf",
  "bad/tumbler-length.glb",
  "legacy/awning.gltf",
  "legacy/lantern.glb",
];

const whole = ({ text, cutLeft, cutRight }) => `${cutLeft ? "…" : ""}${text}${cutRight ? "…" : ""}`;

/** A folder of assets, and the output of the native program for it. */
export class Assets {
  constructor(program, root, place) {
    this.program = program;
    this.place = mkdtempSync(join(place, "native_"));
    this.folder = join(this.place, "assets");
    for (const path of FILES) {
      mkdirSync(dirname(join(this.folder, path)), { recursive: true });
      cpSync(join(root, "fixtures", path), join(this.folder, path));
    }
    this.assets = FILES.filter((path) => /\.gl(tf|b)$/.test(path))
      .map((path) => `assets/${path}`)
      .sort();
  }

  run(...args) {
    const done = spawnSync(this.program, [...args, "--isolated"], { cwd: this.place, encoding: "utf8" });
    assert.ok(done.status <= 1, done.stderr);
    return done.stdout;
  }

  /** Findings of one asset as the page orders them. */
  findings(path) {
    const lines = this.run("validate", path, "--format", "jsonl")
      .trim()
      .split("\n")
      .map((line) => JSON.parse(line));
    const pointers = (one) => [one.pointer, one.lastPointer].filter(Boolean);
    return lines[1].findings
      .sort((a, b) => SEVERITIES.indexOf(a.severity) - SEVERITIES.indexOf(b.severity))
      .map((one) => ({
        severity: one.severity,
        code: one.code,
        message: one.message,
        pointers: pointers(one),
        place: one.location ? [one.location.line, one.location.column] : [],
        line: one.excerpt ? whole(one.excerpt) : "",
        mark: one.excerpt ? one.excerpt.text.substr(one.excerpt.caret, one.excerpt.width) || " " : "",
      }));
  }
}

/** Findings of all assets as they are shown. */
async function shown(page) {
  await unfold(page);
  return page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll("#list details.asset")].map((asset) => [
        asset.querySelector(".path-line bdi").textContent,
        [...asset.querySelectorAll(".finding")].map((one) => {
          const text = (words) => one.querySelector(words)?.textContent ?? "";
          const place = text(".where").match(/^line (\d+), column (\d+)/);
          return {
            severity: text(".label"),
            code: text(".code"),
            message: text("p bdi"),
            pointers: [...one.querySelectorAll(".where .mono bdi")]
              .map((each) => each.textContent)
              .filter(Boolean),
            place: place ? [Number(place[1]), Number(place[2])] : [],
            line: text(".excerpt bdi"),
            mark: text("mark"),
          };
        }),
      ]),
    ),
  );
}

async function sameFindings(page, native) {
  const all = await shown(page);
  assert.deepEqual(Object.keys(all), native.assets);
  let count = 0;
  for (const path of native.assets) {
    assert.deepEqual(all[path], native.findings(path), path);
    count += all[path].length;
  }
  assert.ok(count >= 8, `only ${count} findings`);
  assert.deepEqual(page.complaints, []);
}

async function findingsOfAFolder(one, url, native) {
  const page = await open(one, url);
  assert.equal(await chooseFolder(one, page, native.folder), "3 of 6 assets have errors.");
  await sameFindings(page, native);
  await page.close();
}

async function findingsOfADroppedFolder(one, url, native) {
  if (one.name !== "chromium") return; // only its debugger drops real folders
  const page = await open(one, url);
  const session = await page.createCDPSession();
  const data = { items: [], files: [native.folder], dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) {
    await session.send("Input.dispatchDragEvent", { type, x: 640, y: 300, data });
  }
  assert.equal(await ended(page), "3 of 6 assets have errors.");
  await sameFindings(page, native);
  await page.close();
}

async function findingsOfFiles(one, url, native) {
  const page = await open(one, url);
  const paths = FILES.slice(0, 4).map((path) => join(native.folder, path));
  assert.equal(await choose(page, "files", ...paths), "1 of 2 assets has errors.");
  const all = await shown(page);
  assert.deepEqual(Object.keys(all), ["lamp.gltf", "tumbler.glb"]);
  assert.deepEqual(all["lamp.gltf"], native.findings("assets/tour/lamp.gltf"));
  // Without its files the lamp has more findings; a dropped .glb needs none.
  assert.equal(await drop(page, [["lamp.gltf", readFileSync(paths[0])]]), "6 errors.");
  assert.equal(await drop(page, [["tumbler.glb", readFileSync(paths[3])]]), "No errors.");
  await page.close();
}

async function findingsOfAZip(one, url, native) {
  const page = await open(one, url);
  const files = FILES.map((path, i) => ({
    path,
    bytes: readFileSync(join(native.folder, path)),
    method: i % 2 ? 8 : 0,
  }));
  const zip = archive([...files, { path: "__MACOSX/._lamp.gltf", bytes: Buffer.from("x") }], {
    comment: "all",
  });
  assert.equal(await drop(page, [["assets.zip", zip]]), "3 of 6 assets have errors.");
  await sameFindings(page, native);
  await page.close();
}

async function factsAreShown(one, url, native) {
  const page = await open(one, url);
  await chooseFolder(one, page, join(native.folder, "tour"));
  await unfold(page);
  const { facts } = JSON.parse(native.run("inspect", "assets/tour/lamp.gltf", "--format", "json")).assets[0];
  const tables = await page.$$eval("#list table", (all) =>
    all.map((one) => [
      one.querySelector("caption").textContent,
      [...one.querySelectorAll("tbody tr")].map((row) => [...row.cells].map((cell) => cell.textContent)),
    ]),
  );
  const rows = Object.fromEntries(tables);
  assert.deepEqual(
    rows.Meshes,
    facts.meshes.map((mesh) => [
      mesh.name,
      `${mesh.primitives}`,
      `${mesh.triangles}`,
      `${mesh.vertices}`,
      `${mesh.bytes} B`,
    ]),
  );
  assert.deepEqual(
    rows.Extensions.map(([name, status]) => [name, status.split(",")[0]]),
    facts.extensions.map((each) => [each.name, each.status]),
  );
  assert.deepEqual(rows.Materials[0].slice(0, 2), [
    facts.materials[0].name,
    facts.materials[0].alphaMode.toLowerCase(),
  ]);
  assert.equal(rows.Images[0][0], facts.images[0].uri);
  await page.close();
}

/** A log without the folder in which the run was. */
function withoutFolder(text) {
  const log = JSON.parse(text);
  for (const run of log.runs) delete run.originalUriBaseIds;
  return log;
}

async function downloadsAreThoseOfTheProgram(one, url, native) {
  const page = await open(one, url);
  await chooseFolder(one, page, native.folder);
  native.run(
    "report",
    ...native.assets,
    "-o",
    "report.html",
    "--no-thumbnails",
    "--fail-on",
    "never",
    "--title=assets",
    "--quiet",
  );
  const html = await download(one, page, "#get-html");
  assert.equal(html.name, "gltfx-report.html");
  assert.ok(html.bytes.equals(readFileSync(join(native.place, "report.html"))));
  native.run("validate", ...native.assets, "--fail-on", "never", "--quiet", "--format", "sarif=log.sarif");
  await ended(page);
  const sarif = await download(one, page, "#get-sarif");
  assert.equal(sarif.name, "gltfx.sarif");
  assert.deepEqual(
    withoutFolder(sarif.bytes),
    withoutFolder(readFileSync(join(native.place, "log.sarif"), "utf8")),
  );
  await ended(page);
  await changesAreThoseOfTheProgram(one, page, native, "upgrade", "upgraded", 2);
  await ended(page);
  await changesAreThoseOfTheProgram(one, page, native, "fix", "fixed", 2);
  await ended(page);
  const packed = await download(one, page, "#get-packed");
  assert.equal(packed.name, "packed.zip");
  assert.ok(packed.bytes.includes(Buffer.from("glTF\x02\0\0\0")));
  assert.deepEqual(page.complaints, []);
  await page.close();
}

const filesBelow = (place) =>
  readdirSync(place, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => relative(place, join(entry.parentPath ?? entry.path, entry.name)))
    .sort();

/** Several files change: an archive, which another program unpacks. `count`: assets that can be changed. */
async function changesAreThoseOfTheProgram(one, page, native, verb, kind, count) {
  const button = `#get-${kind}`;
  assert.equal(await page.$eval(button, ({ textContent }) => textContent), `${count} ${kind} files`);
  const zip = await download(one, page, button);
  assert.equal(zip.name, `${kind}.zip`);
  const place = mkdtempSync(join(native.place, `${kind}_`));
  writeFileSync(join(place, "made.zip"), zip.bytes);
  const unpacked = spawnSync("python3", ["-m", "zipfile", "-e", "made.zip", "got"], { cwd: place, encoding: "utf8" });
  assert.equal(unpacked.status, 0, unpacked.stderr);
  cpSync(native.folder, join(place, "expected", "assets"), { recursive: true });
  spawnSync(native.program, [verb, "assets", "--in-place", "--isolated"], { cwd: join(place, "expected") });
  const bytesOf = (folder, path) => readFileSync(join(folder, path));
  const changed = filesBelow(join(place, "expected")).filter(
    (path) => !bytesOf(join(place, "expected"), path).equals(bytesOf(native.place, path)),
  );
  assert.ok(changed.length > 1);
  assert.deepEqual(filesBelow(join(place, "got")), changed);
  for (const path of changed)
    assert.ok(bytesOf(join(place, "got"), path).equals(bytesOf(join(place, "expected"), path)), path);
}

async function oneUpgradeIsAFile(one, url, native) {
  const page = await open(one, url);
  const path = join(native.folder, "legacy/awning.gltf");
  await choose(page, "files", path);
  const got = await download(one, page, "#get-upgraded");
  assert.equal(got.name, "awning.gltf");
  native.run("upgrade", "assets/legacy/awning.gltf", "-o", "awning.gltf");
  assert.ok(got.bytes.equals(readFileSync(join(native.place, "awning.gltf"))));
  await page.close();
}

/** [name, check] */
export function resultChecks(one, url, native) {
  return [
    ["findings of a folder", () => findingsOfAFolder(one, url, native)],
    ["findings of a folder that is dropped", () => findingsOfADroppedFolder(one, url, native)],
    ["findings of files", () => findingsOfFiles(one, url, native)],
    ["findings of a .zip", () => findingsOfAZip(one, url, native)],
    ["facts", () => factsAreShown(one, url, native)],
    ["downloads", () => downloadsAreThoseOfTheProgram(one, url, native)],
    ["one upgrade is a file", () => oneUpgradeIsAFile(one, url, native)],
  ];
}

// SPDX-License-Identifier: Apache-2.0
// What hostile names, files and archives cannot do; that nothing leaves the page; that it can be stopped.
import assert from "node:assert/strict";
import { mkdirSync, readdirSync, readFileSync, truncateSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { basename, join } from "node:path";
import { assetWith, HOSTILE_URIS } from "../npm/hostile_paths.mjs";
import { BREAKERS, writeHostile } from "../page/hostile.mjs";
import { archive } from "./archives.mjs";
import { choose, chooseFolder, download, drop, ended, open, unfold, until } from "./browsers.mjs";

const GOOD = Buffer.from('{"asset": {"version": "2.0"}}');

async function unbroken(page) {
  assert.equal(await page.evaluate(() => window.broken), undefined);
  assert.equal(
    await page.evaluate(() => document.querySelectorAll("main :is(img, svg, script, b b, iframe)").length),
    0,
  );
  assert.deepEqual(page.complaints, []);
}

async function textStaysText(one, url, place) {
  const page = await open(one, url);
  const folder = writeHostile(place);
  await chooseFolder(one, page, folder);
  await unfold(page);
  assert.equal((await page.$$("#list > li")).length, readdirSync(folder).length);
  const text = await page.$eval("#list", (element) => element.textContent);
  assert.ok(text.includes(BREAKERS[0]));
  assert.ok(text.includes("\\u202egnp.elif"));
  assert.ok(!/[\u0000-\u0008\u202e]/.test(text));
  assert.equal(await page.$eval("#title", (element) => element.textContent), basename(folder));
  await unbroken(page);
  await page.close();
}

/** Files of an archive that are left out, as the page says: {path: why}. */
async function leftOut(page) {
  return page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll("#left-out tbody tr")].map((row) =>
        [...row.cells].map((cell) => cell.textContent),
      ),
    ),
  );
}

async function namesCannotLeadOut(one, url) {
  const page = await open(one, url);
  const bad = [
    "../up.gltf",
    "/top.gltf",
    "a/../../b.gltf",
    "w\\..\\..\\b.gltf",
    "..\\c.gltf",
    "d//e.gltf",
    "g\0.gltf",
    `${"h".repeat(256)}.gltf`,
    "same.gltf",
    "same.gltf/below.gltf",
  ];
  const good = [
    "same.gltf",
    "<img src=x onerror=window.broken=1>.gltf",
    "\u202eflip\u200b.gltf",
    "-o.gltf",
    "*.gltf",
    "C:/c.gltf",
    "line\nbreak.gltf",
    "gltfx-page/assets",
    "windows\\a\\b.gltf",
    "./here/./f.gltf",
    ".\\h.gltf",
    "folder\\",
    "./",
  ];
  const files = [...good, ...bad].map((path) => ({ path, bytes: GOOD }));
  assert.equal(await drop(page, [["names.zip", archive(files)]]), "None of 10 assets has errors.");
  const why = await leftOut(page);
  const seen = (path) => `names/${path}`.replaceAll("\\", "/").replace("\0", "\\u0000");
  assert.deepEqual(Object.keys(why).sort(), bad.map(seen).sort());
  assert.equal(why["names/../up.gltf"], "its path could lead out of the folder");
  assert.equal(why["names/same.gltf"], "another file has its path");
  assert.equal(why["names/same.gltf/below.gltf"], "a file has the name of its folder");
  const paths = await page.$$eval("#list .path", (all) => all.map((each) => each.textContent));
  assert.deepEqual(
    paths.sort(),
    [
      "names/*.gltf",
      "names/-o.gltf",
      "names/C:/c.gltf",
      "names/<img src=x onerror=window.broken=1>.gltf",
      "names/\\u202eflip\\u200b.gltf",
      "names/line\\u000abreak.gltf",
      "names/same.gltf",
      "names/windows/a/b.gltf",
      "names/here/f.gltf",
      "names/h.gltf",
    ].sort(),
  );
  await unbroken(page);
  await page.close();
}

const entry = (lies) => [{ path: "a.gltf", bytes: GOOD, ...lies }];
const MANY = Array.from({ length: 5 }, (_, i) => ({
  path: `${i}.bin`,
  bytes: Buffer.alloc(1),
  size: 0xfffffff0,
  method: 0,
}));

// Archives that are refused as a whole, or whose file is left out: name, bytes, why, and what is left out if that is
// not the archive.
const REFUSED = [
  ["no archive", Buffer.from("PK, but no archive"), "it is not a whole zip archive"],
  ["cut off", archive(entry(), { cut: 3 }), "it is not a whole zip archive"],
  ["large", archive(MANY), "it unpacks to more than 4 GB"],
  ["bomb", archive(entry({ size: 300 << 20 })), "it unpacks to far more than it is"],
  ["overlap", archive([...entry(), { path: "b.gltf", bytes: GOOD, same: true }]), "files in it overlap"],
  ["zip64", archive(entry(), { entries: 0xffff }), "it is a ZIP64 archive; unpack it first"],
  ["list", archive(entry(), { entries: 7 }), "its list of files is broken"],
  ["encrypted", archive(entry({ flags: 0x801 })), "it is encrypted", "encrypted/a.gltf"],
  ["link", archive(entry({ attributes: 0xa1ff0000 })), "it is a symbolic link", "link/a.gltf"],
  ["method", archive(entry({ method: 12 })), "it is packed by a method other than deflate", "method/a.gltf"],
  ["ratio", archive(entry({ size: 100 << 20 })), "its size is wrong", "ratio/a.gltf"],
];

// Archives with a file that differs from its declaration when it is read.
const LYING = [
  [
    "more",
    archive(entry({ bytes: Buffer.alloc(64 << 20, 32), size: 1000 })),
    "it unpacks to more than its archive says",
  ],
  ["less", archive(entry({ size: GOOD.length + 1 })), "it unpacks to less than its archive says"],
  ["sum", archive(entry({ crc: 1 })), "its checksum is wrong"],
];

async function archivesAreRefused(one, url) {
  const page = await open(one, url);
  for (const [name, bytes, why, path = `${name}.zip`] of REFUSED) {
    assert.equal(await drop(page, [[`${name}.zip`, bytes]]), `${path} is not checked: ${why}.`, name);
    assert.deepEqual(await leftOut(page), { [path]: why }, name);
    assert.equal(await page.$eval("#left-out details", (fold) => fold.open), true, name);
  }
  const [name, bytes, why] = REFUSED[0];
  const good = ["good.gltf", GOOD];
  assert.equal(await drop(page, [good, [`${name}.zip`, bytes]]), `No errors. ${name}.zip is not checked: ${why}.`);
  assert.equal(
    await drop(page, [["a.7z", "7z"]]),
    "a.7z is not checked: it is no .zip archive; unpack it first.",
  );
  for (const [name, bytes, why] of LYING) {
    assert.equal(await drop(page, [[`${name}.zip`, bytes]]), "Not checked.", name);
    assert.match(await page.$eval("#list .body", (body) => body.textContent), new RegExp(why), name);
  }
  await unbroken(page);
  await page.close();
}

/** Each of these is checked like any other; the page stays as it is. */
async function filesCannotBreakIt(one, url) {
  const page = await open(one, url);
  const glb = (length) => {
    const bytes = Buffer.from("glTF\0\0\0\0\0\0\0\0\0\0\0\0JSON{}  ", "latin1");
    bytes.writeUInt32LE(2, 4);
    bytes.writeUInt32LE(bytes.length, 8);
    bytes.writeUInt32LE(length, 12);
    return bytes;
  };
  const files = [
    ["deep.gltf", "[".repeat(1 << 20)],
    ["quotes.gltf", '"'.repeat(1 << 20)],
    ["escapes.gltf", '"' + '\\"'.repeat(1 << 19)],
    ["percent.gltf", '{"a": "%E0%A4%A", "b": "%00"}'],
    ["empty.gltf", ""],
    ["zeros.gltf", Buffer.alloc(1 << 20)],
    ["long.glb", glb(0xffffffff)],
    ["none.glb", glb(0)],
    ["short.glb", "glTF"],
  ];
  assert.equal(await drop(page, files), `${files.length} of ${files.length} assets have errors.`);
  await unbroken(page);
  await page.close();
}

/** A file that is larger than the engine's memory is not even read. */
async function largeFilesAreRefused(one, url, place) {
  const page = await open(one, url);
  const path = join(place, "large.glb");
  writeFileSync(path, "glTF");
  truncateSync(path, 2 ** 30 + 1);
  assert.equal(await choose(page, "files", path), "Not checked.");
  assert.match(await page.$eval("#list .body", (body) => body.textContent), /more than 1 GB/);
  await unbroken(page);
  await page.close();
}

async function canBeStopped(one, url) {
  const page = await open(one, url);
  await page.evaluate(() => {
    const seen = new MutationObserver(() => {
      seen.disconnect();
      document.getElementById("stop").click();
    });
    seen.observe(document.getElementById("list"), { childList: true });
  });
  const three = ["a", "b", "c"].map((name) => [`${name}.gltf`, GOOD]);
  assert.equal(await drop(page, three), "Stopped. 2 assets not checked, from b.gltf on.");
  assert.equal(await page.evaluate(() => document.activeElement.id), "title");
  if (one.name === "chromium") {
    await until("end of the worker", () => page.workers().length === 0);
  }
  assert.equal((await page.$$("#list > li")).length, 1);
  assert.equal(await page.$eval("#downloads", (element) => element.hidden), true);
  // The next drop starts a new run, and a drop before the end replaces the last one.
  assert.equal(await drop(page, three), "None of 3 assets has errors.");
  await page.evaluate(() => {
    document.getElementById("get-html").click();
    document.getElementById("stop").click();
  });
  assert.equal(await ended(page), "Stopped.");
  assert.equal((await page.$$("#list > li")).length, 3);
  const last = drop(page, three);
  assert.equal(await drop(page, [["d.gltf", GOOD]]), "No errors.");
  await last;
  assert.deepEqual(await page.$$eval("#list .path", (all) => all.map((each) => each.textContent)), [
    "d.gltf",
  ]);
  await unbroken(page);
  await page.close();
}

/** From a server: the page is the only requested file. */
async function nothingIsAsked(one, file, native) {
  const asked = [];
  const server = createServer((request, response) => {
    asked.push(`${request.method} ${request.url}`);
    response.setHeader("Content-Type", "text/html; charset=utf-8");
    response.end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const address = `http://127.0.0.1:${server.address().port}`;
  const page = await open(one, `${address}/gltfx.html`);
  await chooseFolder(one, page, native.folder);
  await unfold(page);
  await download(one, page, "#get-html");
  await ended(page);
  const blocked = await page.evaluate(async (place) => {
    new Image().src = `${place}/image`;
    navigator.sendBeacon(`${place}/beacon`, "x");
    return fetch(`${place}/fetch`).then(
      () => false,
      () => true,
    );
  }, address);
  assert.ok(blocked);
  assert.deepEqual(asked, ["GET /gltfx.html"]);
  const others = page.requests.filter((each) => !/^(blob|data):/.test(each) && !each.startsWith(address));
  assert.deepEqual(others, []);
  await page.close();
  await new Promise((done) => server.close(done));
}

async function markupIsRefused(one, url) {
  const page = await open(one, url);
  const refused = await page.evaluate(() => {
    try {
      document.body.innerHTML = "<b>markup</b>";
      return false;
    } catch {
      return true;
    }
  });
  assert.ok(refused, "the policy lets text become markup");
  await page.close();
}

/** A folder whose file cannot be read, and one that cannot even be opened, as entries and as handles. */
async function namesWhatItDoesNotGet(one, url) {
  const page = await open(one, url);
  for (const withHandles of [false, true]) {
    await page.evaluate((areHandles) => {
      document.getElementById("status").textContent = "";
      const good = new File(['{"asset": {"version": "2.0"}}'], "good.gltf");
      const fails = () => Promise.reject(new DOMException("no", "NotReadableError"));
      const fileEntry = (name, file) => ({ name, isDirectory: false, file });
      const inside = [
        fileEntry("good.gltf", (done) => done(good)),
        fileEntry("locked.bin", (done, failed) => failed(new Error("no"))),
      ];
      const folder = {
        name: "folder",
        isDirectory: true,
        createReader: () => ({ readEntries: (done) => done(inside.splice(0)) }),
      };
      const handle = {
        name: "folder",
        kind: "directory",
        async *values() {
          yield { name: "good.gltf", kind: "file", getFile: async () => good };
          yield { name: "locked.bin", kind: "file", getFile: fails };
        },
      };
      const item = (entry, asHandle) => ({
        kind: "file",
        webkitGetAsEntry: () => entry,
        ...(areHandles ? { getAsFileSystemHandle: asHandle } : {}),
      });
      const lost = { name: "lost", isDirectory: true, createReader: () => ({ readEntries: (_, no) => no("no") }) };
      const event = new DragEvent("drop", { bubbles: true, cancelable: true });
      const items = [item(folder, async () => handle), item(lost, fails)];
      Object.defineProperty(event, "dataTransfer", { value: { items, files: [] } });
      document.getElementById("drop").dispatchEvent(event);
    }, withHandles);
    assert.equal(await ended(page), "No errors.");
    const why = "the browser cannot read it";
    assert.deepEqual(await leftOut(page), { lost: why, "folder/locked.bin": why });
  }
  await page.close();
}

/** References to files outside of the asset's folder: findings are those of the program, nothing else is read. */
async function referencesCannotLeadOut(one, url, native) {
  const page = await open(one, url);
  const folder = join(native.place, "paths", "asset");
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(native.place, "paths/secret.bin"), "1234");
  const uris = HOSTILE_URIS.filter(([, needsDisk]) => !needsDisk).map(([uri]) => uri);
  const toServers = uris.filter((uri) => uri.startsWith("http:")); // a warning: viewers may load them
  uris.forEach((uri, i) => writeFileSync(join(folder, `${i}.gltf`), assetWith(uri)));
  assert.equal(
    await chooseFolder(one, page, join(native.place, "paths")),
    `${uris.length - toServers.length} of ${uris.length} assets have errors.`,
  );
  await unfold(page);
  const codes = await page.$$eval("#list details.asset", (all) =>
    all.map((asset) => [
      asset.querySelector(".path-line bdi").textContent,
      [...asset.querySelectorAll(".finding .code")].map((code) => code.textContent),
    ]),
  );
  assert.equal(codes.length, uris.length);
  for (const [path, found] of codes)
    assert.deepEqual(found, native.findings(path).map(({ code }) => code), path);
  await unbroken(page);
  await page.close();
}

async function saysWhatIsMissing(one, url, native) {
  const page = await open(one, url);
  assert.equal(
    await choose(page, "files", join(native.folder, "tour/quad.bin")),
    "There is no .gltf, .glb or .vrm file in it.",
  );
  assert.equal(await page.$eval("#results", (element) => element.hidden), true);
  await page.close();
}

/** [name, check] */
export function safetyChecks(one, url, file, native) {
  return [
    ["text of assets stays text", () => textStaysText(one, url, native.place)],
    ["names cannot lead out of the folder", () => namesCannotLeadOut(one, url)],
    ["references cannot lead out of the folder", () => referencesCannotLeadOut(one, url, native)],
    ["names what it does not get", () => namesWhatItDoesNotGet(one, url)],
    ["hostile archives are refused", () => archivesAreRefused(one, url)],
    ["hostile files cannot break the page", () => filesCannotBreakIt(one, url)],
    ["large files are refused", () => largeFilesAreRefused(one, url, native.place)],
    ["can be stopped", () => canBeStopped(one, url)],
    ["asks for nothing", () => nothingIsAsked(one, file, native)],
    ["no text becomes markup", () => markupIsRefused(one, url)],
    ["says that there is no asset", () => saysWhatIsMissing(one, url, native)],
  ];
}

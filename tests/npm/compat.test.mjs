// SPDX-License-Identifier: Apache-2.0
// gltfx/compat and npm's gltf-validator get the same calls; what comes of them is the same.
import assert from "node:assert/strict";
import { test } from "node:test";
import vm from "node:vm";
import { comparable, importFrom, install, outcomeOf, peer, requireFrom, version } from "./packages.mjs";

const folder = install({ native: false });
const ours = await importFrom(folder, "gltfx/compat.mjs");
const utf8 = (text) => new TextEncoder().encode(text);
const minimal = '{"asset":{"version":"2.0"}}';
const external = JSON.stringify({
  asset: { version: "2.0" },
  buffers: [1, 2, 3].map((number) => ({ uri: `b ${number}.bin`, byteLength: 4 })),
  images: [{ uri: "i.png" }, { uri: "b%201.bin" }, { bufferView: 0, mimeType: "image/png" }],
});
const quiet = (options) => ({ writeTimestamp: false, ...options });

// A call with separate functions for each validator, because they may keep state.
async function compare(name, call) {
  const [expected, found] = [await outcomeOf(() => call(peer)), await outcomeOf(() => call(ours))];
  for (const outcome of [expected, found]) if (outcome.report) outcome.report = comparable(outcome.report);
  assert.deepEqual(found, expected, name);
}

const bytesOf = {
  nothing: undefined,
  null: null,
  text: "x",
  array: [123, 125],
  buffer: utf8(minimal).buffer,
  clamped: new Uint8ClampedArray(utf8(minimal)),
  signed: new Int8Array(utf8(minimal)),
  view: new DataView(utf8(minimal).buffer),
  object: {},
  number: 1,
  empty: new Uint8Array(),
  bytes: utf8(minimal),
  Buffer: Buffer.from(minimal),
  subarray: utf8(`xx${minimal}yy`).subarray(2, 2 + minimal.length),
  frozen: Object.seal(utf8(minimal)),
  shared: new Uint8Array(new SharedArrayBuffer(16)).fill(0x20),
  "other realm": vm.runInNewContext("new Uint8Array(12).fill(32)"),
  mark: utf8(`\ufeff${minimal}`),
  ...Object.fromEntries(
    [0, 9, 10, 12, 13, 32, 71, 91, 103, 120, 123].map((byte) => [`[${byte}]`, new Uint8Array(12).fill(byte)]),
  ),
};

test("data", async () => {
  for (const [name, data] of Object.entries(bytesOf)) {
    await compare(name, (validator) => validator.validateBytes(data, quiet()));
    for (const format of ["glb", "gltf", "GLB", "Gltf", " glb", "", "x", null]) {
      await compare(`${name} as ${format}`, (validator) => validator.validateBytes(data, quiet({ format })));
    }
  }
  const texts = [
    "",
    "x",
    "{}",
    "[]",
    "null",
    "1",
    minimal,
    ` ${minimal}`,
    `\ufeff${minimal}`,
    `${minimal}x`,
    "glTF",
  ];
  for (const text of [undefined, null, 1, new String(minimal), utf8(minimal), ...texts]) {
    await compare(`string ${text}`, (validator) => validator.validateString(text, quiet()));
  }
  await compare("no arguments", (validator) => validator.validateString());
  await compare("no arguments", (validator) => validator.validateBytes());
});

test("options that are none", async () => {
  for (const options of [
    1,
    "x",
    true,
    [],
    new String("x"),
    new Date(0),
    new Map(),
    Object.create(null),
    () => {},
  ]) {
    const call = (validator) => validator.validateString(external, options);
    const [expected, found] = [await outcomeOf(() => call(peer)), await outcomeOf(() => call(ours))];
    for (const { report } of [expected, found]) if (report) assert.match(report.validatedAt, /^\d{4}-.*Z$/);
    for (const outcome of [expected, found]) delete outcome.report;
    assert.deepEqual(found, expected, String(typeof options));
  }
  await compare("inherited", (validator) =>
    validator.validateString(external, Object.create(quiet({ maxIssues: 2 }))),
  );
  await compare("frozen", (validator) =>
    validator.validateString(external, Object.freeze(quiet({ maxIssues: 2 }))),
  );
});

const values = {
  uri: [
    "",
    "a b",
    "%",
    "%41%2f",
    "./x/../y",
    "http://[",
    "::",
    "1:2",
    "a\\b",
    "/x",
    "ä",
    "\ud800",
    "c:\\x",
    1,
    {},
    null,
  ],
  format: [1, {}, [], true, null, "glb"],
  maxIssues: [
    0,
    1,
    2,
    3,
    6,
    7,
    8,
    9,
    100,
    -1,
    NaN,
    1.5,
    -0,
    Infinity,
    2 ** 31,
    2 ** 53,
    2 ** 64,
    "1",
    true,
    [],
    {},
    null,
  ],
  onlyIssues: [
    "x",
    {},
    [],
    [1],
    [""],
    ["IO_ERROR"],
    ["UNUSED_OBJECT", "NOPE"],
    ["NOPE"],
    [, "IO_ERROR"],
    new Set(),
    null,
  ],
  severityOverrides: [
    "x",
    1,
    true,
    [],
    {},
    null,
    () => {},
    new Map([["IO_ERROR", 9]]),
    { NOPE: 1 },
    { "": 1 },
    ...[0, 1, 2, 3, 4, -1, "1", 1.5, null, NaN, undefined].map((level) => ({ IO_ERROR: level })),
    { IO_ERROR: 3, UNUSED_OBJECT: 0 },
  ],
  writeTimestamp: ["x", 1, 0, false],
  externalResourceFunction: ["x", 1, {}, [], null],
};
values.ignoredIssues = values.onlyIssues;

for (const [name, list] of Object.entries(values)) {
  test(`option ${name}`, async () => {
    for (const value of list) {
      const options = () => quiet({ [name]: value });
      await compare(`${name} ${JSON.stringify(value)}`, (validator) =>
        validator.validateString(external, options()),
      );
      await compare(`${name} ${String(value)}`, (validator) =>
        validator.validateBytes(utf8(external), options()),
      );
    }
  });
}

test("the first of several mistakes is named", async () => {
  const wrong = {
    uri: 1,
    externalResourceFunction: 1,
    writeTimestamp: 1,
    format: 1,
    maxIssues: -1,
    onlyIssues: 1,
    ignoredIssues: 1,
    severityOverrides: 1,
  };
  const order = [
    "format",
    "maxIssues",
    "ignoredIssues",
    "onlyIssues",
    "severityOverrides",
    "uri",
    "externalResourceFunction",
    "writeTimestamp",
  ];
  for (const data of [Uint8Array.of(120), utf8(minimal)]) {
    const left = { ...wrong };
    for (const name of order) {
      await compare(`up to ${name}`, (validator) => validator.validateBytes(data, { ...left }));
      delete left[name];
    }
  }
});

const four = new Uint8Array(4);
const answers = {
  "throws an error": () => {
    throw new Error("boom");
  },
  "throws an error of a class": () => {
    throw new (class Own extends Error {})("boom");
  },
  "throws text": () => {
    throw "boom";
  },
  "throws null": () => {
    throw null;
  },
  "throws an object": () => {
    throw { a: 1 };
  },
  "gives nothing": () => {},
  "gives null": () => null,
  "gives an object": () => ({}),
  "rejects with an error": async () => {
    throw new TypeError("boom");
  },
  "rejects with text": async (uri) => {
    throw `no ${uri}  \n`;
  },
  "rejects with nothing": () => Promise.reject(),
  "rejects with a list": () => Promise.reject([1, ["b"]]),
  "rejects with an object": () => Promise.reject({ toString: () => "own" }),
  "fulfils with text": async () => "x",
  "fulfils with null": async () => null,
  "fulfils with a buffer": async () => new ArrayBuffer(4),
  "fulfils with an array": async () => [1, 2, 3, 4],
  "fulfils with clamped bytes": async () => new Uint8ClampedArray(4),
  "fulfils with bytes": async () => four,
  "fulfils with a Buffer": async () => Buffer.from("abcd"),
  "fulfils with part of a Buffer": async () => Buffer.from("abcdefgh").subarray(2, 6),
  "fulfils with no bytes": async () => new Uint8Array(),
  "fulfils with bytes of another realm": async () => vm.runInNewContext("new Uint8Array(4)"),
  "is a thenable": () => ({
    then: (done) => {
      done(four);
    },
  }),
  "is a thenable that throws": () => ({
    then: () => {
      throw "boom";
    },
  }),
  "depends on the name": async (uri) => {
    if (uri.includes("2")) throw "gone";
    return four;
  },
};

// Texts of failures are the user's own, so they are compared word by word.
function failuresOf(report) {
  return report.issues.messages.filter(({ code }) => code === "IO_ERROR").map(({ message }) => message);
}

for (const [name, answer] of Object.entries(answers)) {
  test(`externalResourceFunction ${name}`, async () => {
    const run = async (validator) => {
      const calls = [];
      const externalResourceFunction = (uri) => {
        calls.push(uri);
        return answer(uri);
      };
      const outcome = await outcomeOf(() =>
        validator.validateString(external, quiet({ externalResourceFunction })),
      );
      if (outcome.report) {
        outcome.failures = failuresOf(outcome.report);
        outcome.report = comparable(outcome.report);
      }
      return { calls, outcome };
    };
    assert.deepEqual(await run(ours), await run(peer));
  });
}

test("externalResourceFunction is called in turn, once for each use, up to the limit", async () => {
  for (const maxIssues of [0, 1, 5, 6, 7, 8, 9, 10, 11, 12, 20, 60]) {
    for (const fails of [true, false]) {
      const run = async (validator) => {
        const calls = [];
        const externalResourceFunction = async (uri) => {
          calls.push(`begin ${uri}`);
          await new Promise((done) => setImmediate(done));
          calls.push(`end ${uri}`);
          if (fails) throw uri;
          return four;
        };
        const report = await validator.validateString(
          external,
          quiet({ maxIssues, externalResourceFunction }),
        );
        return { calls, report: comparable(report) };
      };
      assert.deepEqual(await run(ours), await run(peer), `limit ${maxIssues}, fails: ${fails}`);
    }
  }
});

test("without externalResourceFunction each external resource is an error that says so", async () => {
  const [expected, found] = await Promise.all([peer, ours].map((one) => one.validateString(external)));
  assert.equal(failuresOf(expected).length, 5);
  assert.deepEqual(failuresOf(found), failuresOf(expected));
});

test("URIs are given as the other validator writes them", async () => {
  const uris = [
    "a b",
    "a%20b",
    "./a",
    "x/../a",
    "../a",
    "a%2fb",
    "%41",
    "ä",
    "[x]",
    "a|b^{}`",
    "☃",
    "a+b;c=1,2!*'()~@&$",
    "é%C3%A9",
    'a"b',
    "x//y",
    "a/.",
  ];
  const asset = JSON.stringify({
    asset: { version: "2.0" },
    buffers: uris.map((uri) => ({ uri, byteLength: 4 })),
  });
  const run = async (validator) => {
    const calls = [];
    const externalResourceFunction = async (uri) => {
      calls.push(uri);
      return four;
    };
    const { info, issues } = await validator.validateString(asset, { externalResourceFunction });
    return { calls, resources: info.resources, errors: issues.numErrors };
  };
  assert.deepEqual(await run(ours), await run(peer));
});

test("what the caller changes after the call does not matter", async () => {
  for (const validator of [ours, requireFrom(folder)("gltfx/compat")]) {
    // The engine may have to start, or be ready; resources are fetched before the asset is read again.
    const withBuffer = '{"asset":{"version":"2.0"},"buffers":[{"uri":"a","byteLength":4}]}';
    const externalResourceFunction = async () => four;
    for (const [asset, options] of [[minimal], [minimal], [withBuffer, { externalResourceFunction }]]) {
      const bytes = Buffer.from(asset);
      const promise = validator.validateBytes(bytes, options);
      bytes.fill(0);
      assert.equal((await promise).issues.numErrors, 0);
    }
  }
});

test("bytes with a length of their own are read as far as they go", async () => {
  for (let call = 0; call < 2; ++call) {
    const bytes = Buffer.from(minimal);
    Object.defineProperty(bytes, "length", { value: 3 });
    assert.equal((await ours.validateBytes(bytes)).issues.numErrors, 0);
  }
});

test("constants", () => {
  const common = requireFrom(folder)("gltfx/compat");
  for (const validator of [ours, common]) {
    assert.equal(validator.version(), version);
    const names = [...peer.supportedExtensions(), "KHR_node_visibility"].sort();
    assert.deepEqual(validator.supportedExtensions(), names);
    assert.notEqual(validator.supportedExtensions(), validator.supportedExtensions());
  }
  assert.deepEqual(Object.keys(common), Object.keys(peer));
});

test("supportedExtensions are those that are not reported as unsupported", async () => {
  const names = [...peer.supportedExtensions(), "KHR_materials_diffuse_transmission", "ACME_none"];
  const asset = JSON.stringify({ asset: { version: "2.0" }, extensionsUsed: names });
  await compare("extensions", (validator) => validator.validateString(asset, quiet()));
});

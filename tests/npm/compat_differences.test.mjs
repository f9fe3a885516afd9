// SPDX-License-Identifier: Apache-2.0
// Where gltfx/compat differs from npm's gltf-validator: a test for each row of the table in docs/npm.md.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { importFrom, install, modules, outcomeOf, peer, root, version } from "./packages.mjs";

const ours = await importFrom(install({ native: false }), "gltfx/compat.mjs");
const four = new Uint8Array(4);
const tested = new Set();

const assetWith = (...uris) =>
  JSON.stringify({ asset: { version: "2.0" }, buffers: uris.map((uri) => ({ uri, byteLength: 4 })) });
const both = (call) => Promise.all([peer, ours].map((validator) => outcomeOf(() => call(validator))));
const errorsOf = ({ report }) =>
  report.issues.messages.filter(({ severity }) => severity === 0).map(({ code }) => code);

function row(name, run) {
  tested.add(name);
  test(name, run);
}

// Differences of the program that the functions do not have.
function same(name, run) {
  test(`no difference: ${name}`, run);
}

row("`version()`, `validatorVersion`", async () => {
  const [theirs, mine] = await both((validator) => validator.validateString("{}"));
  assert.deepEqual([theirs.report.validatorVersion, mine.report.validatorVersion], [peer.version(), version]);
});

row("words of `message`", async () => {
  const [theirs, mine] = await both((validator) => validator.validateString("[]"));
  assert.equal(theirs.report.issues.messages[0].code, mine.report.issues.messages[0].code);
  assert.notEqual(theirs.report.issues.messages[0].message, mine.report.issues.messages[0].message);
});

row("options that are a symbol or a bigint", async () => {
  for (const options of [Symbol("x"), 1n]) {
    const [theirs, mine] = await both((validator) => validator.validateString("{}", options));
    assert.match(theirs.text, /^TypeError: /);
    assert.equal(mine.text, "Invalid argument(s): options: Value must be an object.");
  }
});

row("function gives a number, a string, a boolean or `{ then: 1 }`", async () => {
  for (const answer of [1, "x", true, { then: 1 }]) {
    const externalResourceFunction = () => answer;
    const [theirs, mine] = await both((one) =>
      one.validateString(assetWith("a"), { externalResourceFunction }),
    );
    assert.match(theirs.text, /^NoSuchMethodError: /);
    assert.equal(
      mine.text,
      "Invalid argument(s): options.externalResourceFunction: Function must return a Promise.",
    );
  }
});

row("function throws a `RangeError`, or uses what is not there", async () => {
  const cases = [
    [
      () => {
        throw new RangeError("r");
      },
      "Invalid argument(s): r",
      "Error: r",
    ],
    [() => null.x, /^NoSuchMethodError: /, /^Error: Cannot read/],
  ];
  for (const [externalResourceFunction, ...texts] of cases) {
    const found = await both((one) => one.validateString(assetWith("a"), { externalResourceFunction }));
    assert.deepEqual(
      found.map(({ rejected }) => rejected),
      ["string", "string"],
    );
    found.forEach(({ text }, at) =>
      (texts[at] instanceof RegExp ? assert.match : assert.equal)(text, texts[at]),
    );
  }
});

row("promise is rejected with a symbol", async () => {
  const code = `require(${JSON.stringify(join(modules, "gltf-validator"))}).validateString(
    ${JSON.stringify(assetWith("a"))}, { externalResourceFunction: () => Promise.reject(Symbol("x")) })`;
  assert.throws(() => execFileSync(process.execPath, ["-e", code], { stdio: "pipe" }));
  const externalResourceFunction = () => Promise.reject(Symbol("x"));
  const report = await ours.validateString(assetWith("a"), { externalResourceFunction });
  assert.equal(report.issues.messages.at(-1).message, "Node Exception: Symbol(x)");
});

row("first call of the function", async () => {
  for (const [validator, expected] of [
    [peer, true],
    [ours, false],
  ]) {
    let called = false;
    const externalResourceFunction = async () => {
      called = true;
      return four;
    };
    const promise = validator.validateString(assetWith("a"), { externalResourceFunction });
    assert.equal(called, expected);
    await promise;
    assert.equal(called, true);
  }
});

row("one URI, different answers", async () => {
  const run = async (validator) => {
    let calls = 0;
    const externalResourceFunction = async () => {
      if (++calls === 2) throw "gone";
      return four;
    };
    const report = await validator.validateString(assetWith("a", "a"), { externalResourceFunction });
    return [calls, report.issues.numErrors];
  };
  assert.deepEqual(
    [await run(peer), await run(ours)],
    [
      [2, 1],
      [2, 0],
    ],
  );
});

same("backslash, or `%` that is no escape, in a URI", async () => {
  for (const uri of ["a\\b", "a%zz", "%"]) {
    const calls = [];
    const externalResourceFunction = async (name) => {
      calls.push(name);
      return four;
    };
    const [theirs, mine] = await both((one) =>
      one.validateString(assetWith(uri), { externalResourceFunction }),
    );
    assert.deepEqual([calls.length, calls[0], errorsOf(mine)], [2, calls[1], errorsOf(theirs)]);
  }
});

same("bytes of a URI that is not relative", async () => {
  const externalResourceFunction = async (uri) => {
    throw uri;
  };
  for (const uri of ["http://example.com/x", "/x", "a?b"]) {
    const [theirs, mine] = await both((one) =>
      one.validateString(assetWith(uri), { externalResourceFunction }),
    );
    assert.deepEqual([errorsOf(theirs), errorsOf(mine)], [["IO_ERROR"], ["IO_ERROR"]]);
  }
});

row("half of a surrogate pair in a string", async () => {
  const json = '{"asset":{"version":"2.0","generator":"\ud800"}}';
  const [theirs, mine] = await both((validator) => validator.validateString(json));
  assert.deepEqual(
    [theirs, mine].map(({ report }) => report.info.generator),
    ["\ud800", "\ufffd"],
  );
});

same("fewer than 12 bytes read as a GLB, beginning with another word", async () => {
  const [theirs, mine] = await both((one) =>
    one.validateBytes(new Uint8Array(8).fill(32), { format: "glb" }),
  );
  assert.deepEqual(
    [errorsOf(theirs), errorsOf(mine)],
    [["GLB_UNEXPECTED_END_OF_HEADER"], ["GLB_UNEXPECTED_END_OF_HEADER"]],
  );
});

same("Git LFS pointer", async () => {
  const bytes = new Uint8Array(readFileSync(join(root, "tests/golden/cases/19-git-lfs-pointer.glb")));
  const [theirs, mine] = await both((validator) => validator.validateBytes(bytes, { format: "glb" }));
  assert.deepEqual(errorsOf(mine), errorsOf(theirs));
});

row("element of `meshes` that is no object", async () => {
  const [theirs, mine] = await both((one) => one.validateString('{"asset":{"version":"2.0"},"meshes":[1]}'));
  assert.equal(theirs.rejected, "string");
  assert.deepEqual(errorsOf(mine), ["TYPE_MISMATCH"]);
});

row("`KHR_node_visibility`", async () => {
  const json = '{"asset":{"version":"2.0"},"extensionsUsed":["KHR_node_visibility"]}';
  const [theirs, mine] = await both((validator) => validator.validateString(json));
  assert.deepEqual(
    [theirs, mine].map(({ report }) => report.issues.messages.length),
    [1, 0],
  );
});

row("integer beyond 2^53, such as `1e300`", async () => {
  for (const [number, expected] of [
    ["9007199254740992", []],
    ["1e16", ["TYPE_MISMATCH"]],
    ["1e300", ["TYPE_MISMATCH"]],
  ]) {
    const accessor = `{"componentType":5126,"type":"SCALAR","count":${number}}`;
    const json = `{"asset":{"version":"2.0"},"accessors":[${accessor}]}`;
    const [theirs, mine] = await both((validator) => validator.validateString(json));
    assert.deepEqual([errorsOf(theirs), errorsOf(mine)], [[], expected], number);
  }
});

row("empty JSON chunk, then one longer than the file", async () => {
  const bytes = new Uint8Array(32);
  const view = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, 0, 0x4e4f534a, 100, 0x004e4942].forEach((word, at) =>
    view.setUint32(4 * at, word, true),
  );
  const [theirs, mine] = await both((validator) => validator.validateBytes(bytes, { format: "glb" }));
  assert.deepEqual(
    errorsOf(theirs).filter((code) => code !== "INVALID_JSON"),
    errorsOf(mine),
  );
  assert.ok(errorsOf(theirs).includes("INVALID_JSON") && errorsOf(mine).length > 0);
});

row("skinned mesh in a child node", async () => {
  const accessor = (componentType, type, more) => ({ componentType, type, count: 3, ...more });
  const asset = (parent) => ({
    asset: { version: "2.0" },
    nodes: [{ children: [1], ...parent }, { mesh: 0, skin: 0 }, {}],
    scenes: [{ nodes: [0, 2] }],
    skins: [{ joints: [2] }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, JOINTS_0: 1, WEIGHTS_0: 2 } }] }],
    accessors: [
      accessor(5126, "VEC3", { min: [0, 0, 0], max: [0, 0, 0] }),
      accessor(5121, "VEC4"),
      accessor(5126, "VEC4"),
    ],
  });
  for (const [parent, more] of [
    [{}, []],
    [{ translation: [1, 0, 0] }, [["NODE_SKINNED_MESH_PARENT_TRANSFORMS", 1]]],
  ]) {
    const found = await both((one) => one.validateString(JSON.stringify(asset(parent))));
    const [theirs, mine] = found.map(({ report }) =>
      report.issues.messages.map(({ code, severity }) => [code, severity]),
    );
    assert.deepEqual(theirs, [["NODE_SKINNED_MESH_NON_ROOT", 1]]);
    assert.deepEqual(mine, [...more, ["NODE_SKINNED_MESH_NON_ROOT", 2]]);
  }
});

test("the table has these rows and no others", () => {
  const page = readFileSync(join(root, "docs/npm.md"), "utf8");
  const table = page
    .slice(page.indexOf("| case |"))
    .split("\n\n")[0]
    .split("\n")
    .filter((line) => line.startsWith("| "))
    .slice(1);
  assert.deepEqual(new Set(table.map((line) => line.split(" | ")[0].replace(/^\| /, ""))), tested);
});

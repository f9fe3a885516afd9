// SPDX-License-Identifier: Apache-2.0
// For any bytes, there is a report, or an Error to catch.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { assetsBelow, importFrom, install } from "./packages.mjs";

const folder = install({ native: false });
const { inspect, upgrade, validate } = await importFrom(folder, "gltfx/index.mjs");
const { validateBytes } = await importFrom(folder, "gltfx/compat.mjs");

let state = 1;
function random(limit) {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return Math.floor((state / 2 ** 32) * limit);
}

function* mutations(bytes) {
  yield bytes.subarray(0, random(bytes.length));
  const flipped = bytes.slice();
  for (let count = 1 + random(8); count > 0; --count) flipped[random(flipped.length)] ^= 1 << random(8);
  yield flipped;
  const text = Buffer.from(bytes).toString("latin1");
  yield Buffer.from(
    text.replace(/\d+/g, (number) => (random(10) === 0 ? `${number}${"9".repeat(random(20))}` : number)),
    "latin1",
  );
}

const made = [
  new Uint8Array(),
  new Uint8Array(100000),
  Uint8Array.from({ length: 5000 }, () => random(256)),
  Buffer.from("[".repeat(200000)),
  Buffer.from('{"asset":'.repeat(50000)),
  Buffer.from(
    `{"asset":{"version":"2.0"},"accessors":[{"count":4294967295,"componentType":5126,"type":"MAT4"}]}`,
  ),
  Buffer.from("676c5446020000000c000000ffffffff4a534f4e", "hex"),
  Buffer.from([0xff, 0xfe, 0x7b, 0]),
];

async function survives(bytes, name) {
  const calls = {
    validate: () => validate(bytes),
    strict: () => validate(bytes, { profile: "strict" }),
    inspect: () => inspect(bytes),
    upgrade: () => upgrade(bytes, { unsafe: true }),
    compat: () => validateBytes(bytes, { externalResourceFunction: async () => bytes }),
  };
  for (const [what, call] of Object.entries(calls)) {
    const outcome = await call().then(
      (value) => value,
      (error) => error,
    );
    const isFine =
      outcome instanceof Error ||
      typeof outcome === "object" ||
      (what === "compat" && outcome === "Invalid data: could not detect glTF format.");
    assert.ok(isFine, `${what} of ${name}: ${outcome}`);
    if (what === "validate") assert.ok(Array.isArray(outcome.findings), `validate of ${name}: ${outcome}`);
  }
}

test("bytes that were made to break", async () => {
  for (const [at, bytes] of made.entries()) await survives(bytes, `number ${at}`);
});

test("fixtures with bytes changed, cut off, and with large numbers", async () => {
  const paths = assetsBelow("fixtures/good", "fixtures/bad", "fixtures/legacy").filter(
    (_, at) => at % 4 === 0,
  );
  for (const path of paths) {
    for (const bytes of mutations(new Uint8Array(readFileSync(path)))) await survives(bytes, path);
  }
  assert.equal((await validate(Buffer.from('{"asset":{"version":"2.0"}}'))).counts.errors, 0);
});

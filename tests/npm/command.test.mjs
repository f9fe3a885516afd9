// SPDX-License-Identifier: Apache-2.0
// `gltfx` with and without the native program: the same output, files and exit codes.
import assert from "node:assert/strict";
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { command, install, root, temporaryFolder, version } from "./packages.mjs";

const native = install({ native: true });
const engine = install({ native: false });
assert.ok(existsSync(join(native, "node_modules/@gltfx/linux-x64/bin/gltfx")));
assert.ok(!existsSync(join(engine, "node_modules/@gltfx")));

// A folder with assets, a configuration above, a schema, an ignored file.
function project() {
  const folder = temporaryFolder();
  mkdirSync(join(folder, "assets/sub"), { recursive: true });
  mkdirSync(join(folder, "out"));
  mkdirSync(join(folder, "empty"));
  for (const name of ["leaf.gltf", "leaf.bin", "bowl.glb"]) {
    cpSync(join(root, "fixtures/good", name), join(folder, "assets", name));
  }
  cpSync(join(root, "fixtures/legacy/awning.gltf"), join(folder, "assets/sub/awning.gltf"));
  cpSync(join(root, "tests/golden/cases/06-misspelt-property.gltf"), join(folder, "assets/sub/bad.gltf"));
  cpSync(join(root, "tests/golden/cases/20-missing-bin.gltf"), join(folder, "assets/missing bin.gltf"));
  writeFileSync(join(folder, "gltfx.toml"), '[rules]\nUNUSED_OBJECT = "off"\n');
  writeFileSync(join(folder, "list.txt"), "assets/leaf.gltf\nassets/bowl.glb\n");
  return folder;
}

function filesBelow(folder, prefix = "") {
  return readdirSync(join(folder, prefix), { withFileTypes: true })
    .flatMap((entry) => {
      const name = join(prefix, entry.name);
      return entry.isDirectory()
        ? filesBelow(folder, name)
        : [[name, readFileSync(join(folder, name)).toString("latin1")]];
    })
    .sort();
}

const commands = [
  [],
  ["--help"],
  ["validate"],
  ["validate", "--no-such"],
  ["polish"],
  ["validate", "none.gltf"],
  ["validate", "empty"],
  ["validate", "assets"],
  ["validate", "assets/", "--format", "json"],
  ["validate", "assets/leaf.gltf"],
  ["validate", "assets/missing bin.gltf"],
  ["validate", "assets/*.glb", "assets/**/bad.gltf"],
  ["validate", "./assets/../assets/leaf.gltf", "--isolated"],
  ["validate", "--files-from", "list.txt"],
  ["validate", "assets", "--format=json=out/report.json", "--quiet"],
  ["validate", "assets", "--fail-on", "never"],
  ["validate", "assets/sub", "--write-baseline", "known.json"],
  ["validate", "assets/sub", "--select", "UNEXPECTED_PROPERTY"],
  ["upgrade", "assets/sub/awning.gltf"],
  ["upgrade", "assets/sub/awning.gltf", "--diff"],
  ["upgrade", "assets/sub/awning.gltf", "-o", "out/new.gltf"],
  ["upgrade", "assets/sub/awning.gltf", "-o", "no/such/new.gltf"],
  ["upgrade", "assets/sub/awning.gltf", "--in-place", "--backup"],
  ["upgrade", "assets/sub", "--check"],
  ["inspect", "assets/leaf.gltf", "--format", "json"],
  ["explain", "UNUSED_OBJECT"],
  ["explain", "NOPE"],
];

for (const args of commands) {
  test(`gltfx ${args.join(" ")}`, () => {
    const [expected, found] = [native, engine].map((place) => {
      const cwd = project();
      return { ...command(place, args, { cwd }), files: filesBelow(cwd) };
    });
    assert.deepEqual(found, expected);
  });
}

test("paths outside the working folder, absolute ones, standard input", () => {
  const folder = project();
  const input = readFileSync(join(folder, "assets/sub/bad.gltf"));
  const runs = [
    [["validate", "../leaf.gltf", "../../assets/bowl.glb"], {}],
    [["validate", join(folder, "assets/sub/bad.gltf")], {}],
    [["validate", "-", "--format", "khronos"], { input }],
    [["upgrade", join(folder, "assets/sub/awning.gltf"), "-o", join(folder, "out/")], {}],
  ];
  for (const [args, options] of runs) {
    const [expected, found] = [native, engine].map((place) => {
      const done = command(place, args, { cwd: join(folder, "assets/sub"), ...options });
      return { ...done, files: filesBelow(folder) };
    });
    assert.notEqual(expected.stdout + expected.stderr, "");
    assert.deepEqual(found, expected);
  }
});

test("the version", () => {
  for (const place of [native, engine]) {
    const { stdout } = command(place, ["--version"]);
    assert.match(stdout, new RegExp(`^gltfx ${version}\n`));
    assert.match(stdout, /^decoders built with Draco \d/m);
  }
});

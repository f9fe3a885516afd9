// SPDX-License-Identifier: Apache-2.0
// References of an asset to files outside of its folder: the program, the npm command, the functions of the package and
// the page are tried with the same ones (paths.test.mjs, ../web/safety_checks.mjs).
import { execFileSync } from "node:child_process";
import { mkdirSync, symlinkSync, truncateSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const SECRET = "secret of another user";

/** A folder with files of each kind: `place/asset` for assets, foreign files around it. */
export function makeHostileFolder(place) {
  const folder = join(place, "asset");
  mkdirSync(join(folder, "sub"), { recursive: true });
  writeFileSync(join(place, "secret.bin"), SECRET);
  writeFileSync(join(folder, "own.bin"), "1234");
  for (const name of ["pipe.bin", "sub/pipe.bin"]) execFileSync("mkfifo", [join(folder, name)]);
  const links = {
    "up.bin": "../secret.bin",
    "absolute.bin": join(place, "secret.bin"),
    "zero.bin": "/dev/zero",
    "piped.bin": "pipe.bin",
    "loop.bin": "loop.bin",
    "descriptor.bin": "/proc/self/fd/0",
    above: "..",
  };
  for (const [name, target] of Object.entries(links)) symlinkSync(target, join(folder, name));
  return folder;
}

/** Makes a file that takes no room on the disk. */
export function makeHuge(path, size) {
  writeFileSync(path, "");
  truncateSync(path, size);
}

/** [URI, whether only the disk decides where it leads] */
export const HOSTILE_URIS = [
  ["/dev/zero", false],
  ["/etc/passwd", false],
  ["//host/share/x.bin", false],
  ["file:///etc/passwd", false],
  ["http://127.0.0.1:9/x.bin", false],
  ["C:/Windows/win.ini", false],
  ["C%3A/Windows/win.ini", false],
  ["../secret.bin", false],
  ["../../../../../../../../../../etc/passwd", false],
  ["sub/../../secret.bin", false],
  ["%2e%2e/secret.bin", false],
  ["..%2Fsecret.bin", false],
  ["%2Fdev%2Fzero", false],
  ["..%5Csecret.bin", false],
  ["sub//../../secret.bin", false],
  ["a%00b.bin", false],
  ["sub", true],
  ["pipe.bin", true],
  ["sub/pipe.bin", true],
  ["up.bin", true],
  ["absolute.bin", true],
  ["zero.bin", true],
  ["piped.bin", true],
  ["loop.bin", true],
  ["descriptor.bin", true],
  ["above/secret.bin", true],
  ["above/asset/../secret.bin", true],
];

export function assetWith(uri) {
  const asset = {
    asset: { version: "2.0" },
    buffers: [{ uri, byteLength: 4 }],
    images: [{ uri }],
  };
  return JSON.stringify(asset);
}

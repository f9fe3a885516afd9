#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Breaks valid assets, lets `gltfx fix` do all safe fixes, and searches for changes of meaning.

    tests/mutants/safe_fixes.py build/release/bin/gltfx FOLDER... [--count 3000] [--seed N] [--keep FOLDER]

The checks of each mutant: the fixed asset means what the broken one means (meaning.py), and `gltfx bake` draws the same
picture of both. A few pixels may differ, since a fix may round. The seed of a run is printed; without --seed it is a
new one. Mutants with a failure are kept in --keep.
"""
import argparse
import json
import pathlib
import random
import secrets
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))

import fix_mutants  # noqa: E402
import meaning  # noqa: E402

SIDE = 64
NOISE = 16  # difference of a channel, of 255
MOST_NOISY = 4  # pixels


# Pictures -----------------------------------------------------------------------------------------------------

def unfiltered(data, width, channels):
    """The rows of a PNG of 8 bits."""
    size, rows, above = width * channels, [], bytes(width * channels)
    for start in range(0, len(data), size + 1):
        kind, row = data[start], bytearray(data[start + 1:start + 1 + size])
        for i in range(size):
            left = row[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            if kind == 1:
                row[i] = (row[i] + left) & 255
            elif kind == 2:
                row[i] = (row[i] + above[i]) & 255
            elif kind == 3:
                row[i] = (row[i] + (left + above[i]) // 2) & 255
            elif kind == 4:
                guess = left + above[i] - corner
                row[i] = (row[i] + min((abs(guess - left), 0, left), (abs(guess - above[i]), 1, above[i]),
                                       (abs(guess - corner), 2, corner))[2]) & 255
        rows.append(bytes(row))
        above = row
    return b"".join(rows)


def pixels(path):
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, _, _, color = struct.unpack_from(">IIBB", data, at + 8)
        elif kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += length + 12
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    return unfiltered(zlib.decompress(packed), width, channels), channels


def difference(one, other):
    """As text; empty if two pictures are the same except for noise."""
    if one.read_bytes() == other.read_bytes():
        return ""
    (a, channels), (b, more) = pixels(one), pixels(other)
    if channels != more or len(a) != len(b):
        return "another form"
    wrong = {i // channels for i, (x, y) in enumerate(zip(a, b)) if abs(x - y) > NOISE}
    return f"{len(wrong)} of {SIDE * SIDE} pixels" if len(wrong) > MOST_NOISY else ""


def draw(gltfx, assets, folder, jobs):
    listed = folder.with_suffix(".txt")
    listed.write_text("".join(f"{path}\n" for path in assets))
    done = subprocess.run([gltfx, "bake", "--files-from", str(listed), "-o", f"{folder}/", "--size", str(SIDE),
                           "--samples", "8", "--denoise", "off", "--isolated", "-q", "-j", jobs],
                          capture_output=True, text=True)
    if not 0 <= done.returncode <= 3:
        raise RuntimeError(f"bake exits with {done.returncode}: {done.stderr[-2000:]}")


# Assets -------------------------------------------------------------------------------------------------------

def files_of(folder):
    def read(name):
        path = folder / name
        return path.read_bytes() if ".." not in name and path.is_file() else None
    return read


def read_whole(path):
    data, binary = path.read_bytes(), None
    if data[:4] == b"glTF":
        length = struct.unpack_from("<I", data, 12)[0]
        rest = data[20 + length:]
        binary = rest[8:8 + struct.unpack_from("<I", rest)[0]] if len(rest) >= 8 else b""
        data = data[20:20 + length]
    return meaning.Asset(data.decode("utf-8-sig"), binary, files_of(path.parent))


def read_broken(path, mutant):
    """The intended asset, if the file cannot be read."""
    try:
        if not mutant.glb_change:
            return read_whole(path)
    except (ValueError, struct.error):
        pass
    return meaning.Asset(json.dumps(mutant.document), mutant.binary, files_of(path.parent))


def fixed(gltfx, work, jobs):
    """Outcomes by name."""
    out = fix_mutants.run([gltfx, "fix", str(work / "in"), "--isolated", "--profile", "strict", "--format", "json",
                           "-o", f"{work / 'out'}/", "-j", jobs])
    return {pathlib.Path(file["path"]).parent.name: file for file in json.loads(out)["files"]}


def compare(gltfx, work, mutants, jobs):
    """(name, codes of fixes, what is wrong) of those that changed; all are in the list, most with nothing wrong."""
    changed = {name: file for name, file in fixed(gltfx, work, jobs).items() if file["changes"] and file["written"]}
    before = {name: mutants[name][0] for name in changed}
    after = {name: work / "out" / path.relative_to(work / "in") for name, path in before.items()}
    for folder, paths in (("before", before), ("after", after)):
        draw(gltfx, paths.values(), work / folder, jobs)
    for name, file in changed.items():
        assets = read_broken(before[name], mutants[name][1]), read_whole(after[name])
        wrong = meaning.losses(*assets)
        old, new = (work / folder / f"{name}.png" for folder in ("before", "after"))
        if old.is_file() and not meaning.finds_more(*assets):
            picture = difference(old, new) if new.is_file() else "none is drawn any more"
            wrong += [f"picture: {picture}"] if picture else []
        yield name, sorted(action["code"] for action in file["actions"] if action["done"]), wrong, old.is_file()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gltfx")
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=3000)
    parser.add_argument("--batch", type=int, default=250)
    parser.add_argument("--seed", type=int, default=secrets.randbits(32))
    parser.add_argument("--jobs", default="2")
    parser.add_argument("--largest", type=int, default=200_000, help="bytes of an asset and its files")
    parser.add_argument("--keep", default="")
    words = parser.parse_args()
    print(f"seed {words.seed}", flush=True)
    chance = random.Random(words.seed)
    seeds = fix_mutants.valid_assets(words.gltfx, words.folders, words.largest)
    total = drawn = failures = 0
    for first in range(0, words.count, words.batch):
        with tempfile.TemporaryDirectory(prefix="gltfx_safe_") as folder:
            work, mutants = pathlib.Path(folder), {}
            for number in range(first, min(first + words.batch, words.count)):
                asset, done = fix_mutants.mutant(seeds, chance)
                name = f"m{number:06}"
                mutants[name] = (asset.write(work / "in" / name, name), asset, done)
            for name, fixes, wrong, has_picture in compare(words.gltfx, work, mutants, words.jobs):
                total += 1
                drawn += has_picture
                if not wrong:
                    continue
                failures += 1
                line = f"{name} ({', '.join(mutants[name][2])}; fixed {', '.join(fixes)}): {'; '.join(wrong[:5])}"
                print(line.encode("ascii", "backslashreplace").decode(), flush=True)
                if words.keep:
                    for part in ("in", "out"):
                        kept = pathlib.Path(words.keep) / name / part
                        shutil.rmtree(kept, ignore_errors=True)
                        shutil.copytree(work / part / name, kept)
    print(f"{words.count} mutants, {total} changed by safe fixes, {drawn} pictures of them, {failures} with a failure")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws assets with gltfx and with Cycles: same camera, same environment, no denoiser.

  against_cycles.py [--size N] [--samples LIST] [--reference N] [--threads N] [--cpu] [--work DIR]
                    PROGRAM [ASSET.glb...]

Without assets it makes two, 25 balls and a model of 100,000 triangles; a camera is put into a copy
of each given one. Needs Blender on the path, which brings Cycles and a glTF importer.

For each number of samples it prints seconds from start to file and two errors: the root of the mean
square over the pixels, as part of the mean. `own` is against the same renderer's picture of
--reference samples of another seed, so that what the importer reads differently does not count;
`common` is against the mean of both references. Then it prints the seconds that each renderer needs
for the same error: samples are those of the measurement with the nearest error, by error ~
1 / sqrt(samples), and seconds are linear in samples. No start-up time is subtracted; it is
printed as well, as the time of one sample of 16 by 16 pixels. On a busy machine, --cpu counts
processor time of all threads instead of wall-clock time.
"""
import argparse
import json
import math
import os
import struct
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../cycles"))
sys.dont_write_bytecode = True

import renderers  # noqa: E402  before the rest: it adds the folder of tests/oracle
import cycles_assets  # noqa: E402

BOUNCES = 4


def with_camera(path, target):
    """A copy of a .glb with a camera before it, that both programs take."""
    with open(path, "rb") as file:
        data = file.read()
    size = struct.unpack("<I", data[12:16])[0]
    document, rest = json.loads(data[20:20 + size]), data[20 + size:]
    document["cameras"] = [{"type": "perspective", "perspective": {
        "yfov": 0.6, "znear": 0.05, "aspectRatio": 1}}]
    document["nodes"].append({"camera": 0, "translation": [0, 0, 4.5]})
    document["scenes"][0]["nodes"].append(len(document["nodes"]) - 1)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(target, "wb") as out:
        out.write(b"glTF" + struct.pack("<II", 2, 20 + len(text) + len(rest)))
        out.write(struct.pack("<I4s", len(text), b"JSON") + text + rest)


def assets_of(options):
    """Paths of files with a camera."""
    if not options.assets:
        for name, make in (("balls", cycles_assets.balls), ("model", cycles_assets.model)):
            path = os.path.join(options.work, name + ".gltf")
            with open(path, "w", encoding="utf-8") as out:
                out.write(make().text())
            yield path
    for source in options.assets:
        path = os.path.join(options.work, os.path.basename(source))
        with_camera(source, path)
        yield path


def values_of(picture):
    return [value for row in picture.rows for pixel in row for value in pixel[:3]]


def apart(one, other):
    square = sum((a - b) ** 2 for a, b in zip(one, other)) / len(other)
    return math.sqrt(square) / (sum(other) / len(other))


class Run:
    """One picture of a renderer: samples, seconds, error against its own reference."""

    def __init__(self, samples, seconds, own, common):
        self.samples, self.seconds, self.own, self.common = samples, seconds, own, common

    def __str__(self):
        return (f"{self.samples:5} samples {self.seconds:7.2f} s  own {self.own:.4f}  "
                f"common {self.common:.4f}")


def seconds_for(error, runs):
    """Measurements of a renderer by the number of samples, from few to many."""
    nearest = min(runs, key=lambda run: abs(math.log(run.own / error)))
    samples = nearest.samples * (nearest.own / error) ** 2
    above = next((i for i in range(1, len(runs) - 1) if runs[i].samples >= samples), len(runs) - 1)
    if above == 0:
        return nearest.seconds * samples / nearest.samples
    first, second = runs[above - 1], runs[above]
    slope = (second.seconds - first.seconds) / (second.samples - first.samples)
    return max(first.seconds + slope * (samples - first.samples), 0.0)


def measure(asset, draws, options):
    """Runs by name of the renderer."""
    size, counts = options.size, sorted(map(int, options.samples.split(",")))
    references = {name: values_of(draw(asset, size, options.reference, BOUNCES, seed=1)[1])
                  for name, draw in draws.items()}
    common = [(a + b) / 2 for a, b in zip(*references.values())]
    print(f"{asset}: references {apart(*references.values()):.4f} apart", flush=True)
    runs = {name: [] for name in draws}
    for samples in counts:
        for name, draw in draws.items():
            seconds, picture = draw(asset, size, samples, BOUNCES)
            values = values_of(picture)
            run = Run(samples, seconds, apart(values, references[name]), apart(values, common))
            runs[name].append(run)
            print(f"  {name:7} {run}", flush=True)
    return runs


def print_equal_errors(runs):
    for run in runs["Cycles"]:
        ours, theirs = (seconds_for(run.own, runs[name]) for name in ("gltfx", "Cycles"))
        print(f"  error {run.own:.4f}: gltfx {ours:.2f} s, Cycles {theirs:.2f} s, "
              f"{theirs / ours:.1f} times as long", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("assets", nargs="*")
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--samples", default="16,64")
    parser.add_argument("--reference", type=int, default=1024, help="samples")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--cpu", action="store_true", help="processor time")
    parser.add_argument("--work", default="build/bench-work/cycles")
    options = parser.parse_args()
    try:
        both = renderers.Renderers(options.program, options.work, options.threads,
                                   options.cpu)
        draws = {"gltfx": both.gltfx, "Cycles": both.cycles}
        for asset in assets_of(options):
            runs = measure(asset, draws, options)
            print_equal_errors(runs)
            for name, draw in draws.items():
                print(f"  {name:7} start-up {draw(asset, 16, 1, BOUNCES)[0]:.2f} s", flush=True)
    except renderers.Failure as failure:
        sys.exit(f"against_cycles.py: {failure}")


if __name__ == "__main__":
    main()

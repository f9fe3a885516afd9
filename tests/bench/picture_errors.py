#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Errors of pictures against references of many samples, and their cost.

  picture_errors.py [--size N] [--samples N] [--references DIR] [--also PROGRAM]... [--options TEXT]
                    PROGRAM ASSET...

Draws each asset with `gltfx` programs and prints decibels over the pixels that show the asset (of
the range of 8 bits, colours times alpha), and seconds of processor time, one row an asset. The
references are drawn by PROGRAM without a denoiser, and kept in DIR. A figure of fixtures/figures is
drawn through its own camera, by its own lights.
"""
import argparse
import math
import os
import resource
import shlex
import struct
import subprocess
import sys
import zlib


def read_png(path):
    """Width and RGBA bytes of a PNG of 8 bits without interlacing."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed, width, channels = 8, b"", 0, 4
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, _, bits, color = struct.unpack(">IIBB", body[:10])
            channels = {2: 3, 6: 4}[color]
            assert bits == 8
        elif kind == b"IDAT":
            packed += body
        at += size + 12
    return width, channels, unfilter(zlib.decompress(packed), width * channels, channels)


def unfilter(raw, row_size, step):
    rows, before = bytearray(), bytes(row_size)
    for at in range(0, len(raw), row_size + 1):
        kind, row = raw[at], bytearray(raw[at + 1:at + 1 + row_size])
        for i in range(row_size):
            left = row[i - step] if i >= step else 0
            up, corner = before[i], before[i - step] if i >= step else 0
            if kind == 1:
                row[i] = (row[i] + left) & 255
            elif kind == 2:
                row[i] = (row[i] + up) & 255
            elif kind == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif kind == 4:
                guess = left + up - corner
                near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up),
                           (abs(guess - corner), 2, corner))
                row[i] = (row[i] + near[2]) & 255
        rows += row
        before = row
    return bytes(rows)


def decibels(path, reference):
    _, _, ours = read_png(path)
    _, _, other = read_png(reference)
    total, count = 0.0, 0
    for at in range(0, len(other), 4):
        if other[at + 3] == 0:
            continue
        count += 3
        for c in range(3):
            apart = ours[at + c] * ours[at + 3] - other[at + c] * other[at + 3]
            total += (apart / 255) ** 2
    return 10 * math.log10(255 ** 2 * count / total) if total else math.inf


def draw(program, asset, picture, options):
    own = ["--camera", "0", "--lights", "asset"] if "fixtures/figures" in asset else []
    words = [program, "bake", asset, "-o", picture, "--background", "transparent", "--quiet", *own]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([*words, *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 1) or not os.path.exists(picture):
        return None
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("assets", nargs="+")
    parser.add_argument("--size", default="128")
    parser.add_argument("--samples", default="4096", help="of a reference")
    parser.add_argument("--references", default="build/bench-work/references")
    parser.add_argument("--also", action="append", default=[], help="another program to compare")
    parser.add_argument("--options", default="", help="of the pictures that are compared")
    options = parser.parse_args()
    os.makedirs(options.references, exist_ok=True)
    programs = [options.program, *options.also]
    picture = os.path.join(options.references, f"picture-{os.getpid()}.png")
    sums = [[0.0, 0.0, 0] for _ in programs]
    for asset in options.assets:
        name = os.path.splitext(os.path.basename(asset))[0]
        reference = os.path.join(options.references,
                                 f"{name}-{options.size}-{options.samples}.png")
        if not os.path.exists(reference):
            draw(options.program, asset, reference, ["--size", options.size, "--samples",
                                                     options.samples, "--denoise", "off"])
        cells = []
        for program, total in zip(programs, sums):
            seconds = draw(program, asset, picture,
                           ["--size", options.size, "--seed", "7", *shlex.split(options.options)])
            if seconds is None or not os.path.exists(reference):
                cells.append("no picture")
                continue
            found = decibels(picture, reference)
            os.remove(picture)
            total[0] += found
            total[1] += seconds
            total[2] += 1
            cells.append(f"{found:6.2f} dB {seconds:7.2f} s")
        print(f"{name:36}", "   ".join(cells), flush=True)
    print(f"{'mean':36}", "   ".join(f"{d / n:6.2f} dB {s / n:7.2f} s" if n else "no picture"
                                     for d, s, n in sums))


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes many small assets with findings of several sorts.

Usage: make_assets.py FOLDER COUNT

Ten folders, each with a buffer of 48 MB that some of its assets refer to, so that a run over all of
them takes some seconds. The buffers are one file.
"""
import json
import os
import struct
import sys

POINTS = 4_000_000


def asset(number):
    """A scene with a point cloud, or with what one kind of mistake makes of it."""
    document = {
        "asset": {"version": "2.0", "generator": f"number {number}"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": f"cloud {number}", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
        "buffers": [{"uri": "points.bin", "byteLength": 12 * POINTS}],
        "bufferViews": [{"buffer": 0, "byteLength": 12 * POINTS}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": POINTS,
                       "min": [0, 0, 0], "max": [1, 2, 3]}],
    }
    kind = number % 9
    if kind == 1:
        document["materials"] = [{"name": f"spare {i}"} for i in range(number % 5 + 1)]
    elif kind == 2:
        document["nodes"][0]["colour"] = "red"
    elif kind == 3:
        document["accessors"][0]["max"] = [1, 2, 2.5]
    elif kind == 4:
        document["accessors"][0]["count"] = POINTS + 1
    elif kind == 5:
        document["buffers"][0]["uri"] = f"missing-{number}.bin"
    elif kind == 6:
        document["nodes"][0]["children"] = [0, 7]
    elif kind == 7:
        document["extensionsUsed"] = ["ACME_unheard_of"]
    text = json.dumps(document, indent=1 if number % 2 else None)
    return text[:-1] if kind == 8 else text


def main():
    folder, count = sys.argv[1], int(sys.argv[2])
    os.makedirs(folder)
    points = os.path.join(folder, "points.bin")
    with open(points, "wb") as file:
        file.write(struct.pack("<6f", 0, 0, 0, 1, 2, 3) * (POINTS // 2))
    for i in range(10):
        os.mkdir(os.path.join(folder, f"part {i}"))
        os.link(points, os.path.join(folder, f"part {i}", "points.bin"))
    for number in range(count):
        name = os.path.join(folder, f"part {number % 10}", f"asset-{number}.gltf")
        with open(name, "w", encoding="utf-8") as file:
            file.write(asset(number))


main()

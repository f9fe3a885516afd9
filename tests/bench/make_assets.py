#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the benchmarks' workloads, the same bytes every time.

  make_assets.py FOLDER [--only batch,city] [--files N] [--blocks N]

batch  1,000 small models of a few ten KB, half with the buffer inside, half with a .bin beside
city   one .gltf of some 70 MB of JSON: many nodes, meshes, materials and animation channels
"""
import argparse
import base64
import json
import math
import os
import random
import struct

ASSET = {"version": "2.0", "generator": "gltfx tests/bench"}


def as_float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


class Buffer:
    """Bytes with a view for everything put in."""

    def __init__(self):
        self.data, self.views, self.accessors = bytearray(), [], []

    def add(self, kind, component, code, values, width, target=None, bounds=False):
        raw = struct.pack(f"<{len(values)}{code}", *values)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)}
        if target:
            view["target"] = target
        self.data += raw + b"\0" * (-len(raw) % 4)
        self.views.append(view)
        accessor = {"bufferView": len(self.views) - 1, "componentType": component,
                    "count": len(values) // width, "type": kind}
        if bounds:
            columns = [[as_float32(v) for v in values[i::width]] for i in range(width)]
            accessor["min"] = [min(c) for c in columns]
            accessor["max"] = [max(c) for c in columns]
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def hills(rnd, n):
    """A wavy square of n x n vertices: positions, unit normals, texture coordinates, triangles."""
    a, b, c = rnd.uniform(2, 7), rnd.uniform(2, 7), rnd.uniform(0, 3)
    points, normals, uvs, triangles = [], [], [], []
    for j in range(n):
        for i in range(n):
            x, y = i / (n - 1), j / (n - 1)
            points += [x, 0.1 * math.sin(a * x + c) * math.cos(b * y), y]
            dx = 0.1 * a * math.cos(a * x + c) * math.cos(b * y)
            dy = -0.1 * b * math.sin(a * x + c) * math.sin(b * y)
            length = math.sqrt(dx * dx + dy * dy + 1)
            normals += [-dx / length, 1 / length, -dy / length]
            uvs += [x, y]
            if i + 1 < n and j + 1 < n:
                k = j * n + i
                triangles += [k, k + n, k + 1, k + 1, k + n, k + n + 1]
    return points, normals, uvs, triangles


def colour(rnd, alpha=False):
    return [round(rnd.random(), 4) for _ in range(3)] + ([1.0] if alpha else [])


def material(rnd, i):
    made = {"name": f"paint {i}", "pbrMetallicRoughness": {
        "baseColorFactor": colour(rnd, True), "metallicFactor": round(rnd.random(), 3),
        "roughnessFactor": round(rnd.random(), 3)}, "emissiveFactor": [0.0, 0.0, 0.0]}
    if i % 2 == 0:
        made["extensions"] = {"KHR_materials_ior": {"ior": round(1 + rnd.random(), 3)},
                              "KHR_materials_sheen": {"sheenColorFactor": colour(rnd)}}
    if i % 3 == 0:
        made.setdefault("extensions", {})["KHR_materials_diffuse_transmission"] = {
            "diffuseTransmissionFactor": round(rnd.random(), 3),
            "diffuseTransmissionColorFactor": colour(rnd)}
    return made


USED = ["KHR_materials_ior", "KHR_materials_sheen", "KHR_materials_diffuse_transmission"]


def small_model(rnd):
    buffer = Buffer()
    points, normals, uvs, triangles = hills(rnd, rnd.randint(7, 26))
    attributes = {"POSITION": buffer.add("VEC3", 5126, "f", points, 3, 34962, True),
                  "NORMAL": buffer.add("VEC3", 5126, "f", normals, 3, 34962)}
    indices = buffer.add("SCALAR", 5123, "H", triangles, 1, 34963)
    materials = [material(rnd, i) for i in range(rnd.randint(4, 14))]
    meshes = [{"name": f"part {i}", "primitives": [
        {"attributes": attributes, "indices": indices, "material": i}]}
        for i in range(len(materials))]
    nodes = [{"name": f"assembly {i}", "mesh": i % len(meshes),
              "translation": [round(rnd.uniform(-9, 9), 5) for _ in range(3)],
              "rotation": [0.0, 0.0, 0.0, 1.0], "scale": [1.0, 1.0, 1.0],
              "extras": {"id": "%024x" % rnd.getrandbits(96)}}
             for i in range(rnd.randint(30, 110))]
    document = {"asset": ASSET, "extensionsUsed": USED, "scene": 0,
                "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
                "materials": materials, "accessors": buffer.accessors,
                "bufferViews": buffer.views}
    return document, bytes(buffer.data)


def make_batch(folder, files):
    rnd = random.Random(2)
    for k in range(files):
        document, data = small_model(rnd)
        name = f"model{k:04d}"
        if k % 2:
            uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        else:
            uri = name + ".bin"
            with open(os.path.join(folder, uri), "wb") as out:
                out.write(data)
        document["buffers"] = [{"byteLength": len(data), "uri": uri}]
        with open(os.path.join(folder, name + ".gltf"), "w", encoding="utf-8") as out:
            json.dump(document, out, indent=None if k % 3 else 2)


class Array:
    """Writes a root array of the document piece by piece, indented as exporters do."""

    def __init__(self, out, name):
        out.write(",\n" + json.dumps(name) + ": [")
        self.out, self.empty = out, True

    def add(self, value):
        self.out.write("\n" if self.empty else ",\n")
        self.out.write(json.dumps(value, indent=2, ensure_ascii=False))
        self.empty = False

    def close(self):
        self.out.write("\n]")


def city_nodes(out, rnd, blocks, houses):
    array = Array(out, "nodes")
    array.add({"name": "city", "children": list(range(1, blocks + 1))})
    for b in range(blocks):
        first = blocks + 1 + b * houses
        array.add({"name": f"block {b}", "children": list(range(first, first + houses)),
                   "translation": [float(b % 100), 0.0, float(b // 100)]})
    for h in range(blocks * houses):
        angle = rnd.uniform(0, 3)
        node = {"name": f"block {h // houses}/Haus {h % houses} \u00f6stlich", "mesh": h // 4,
                "translation": [rnd.uniform(-50, 50) for _ in range(3)],
                "rotation": [0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2)]}
        if h % 2:
            node["scale"] = [1.0, rnd.uniform(1, 3), 1.0]
        if h % 8 == 0:
            node["extras"] = {"cadastre": "%032x" % rnd.getrandbits(128), "storeys": h % 9}
        array.add(node)
    array.close()


def city_geometry(out, rnd, count):
    """One triangle a mesh, each with bounds of its own."""
    data, bounds = bytearray(), []
    for _ in range(count):
        values = [as_float32(rnd.uniform(-5, 5)) for _ in range(9)]
        data += struct.pack("<9f", *values)
        bounds.append(([min(values[i::3]) for i in range(3)], [max(values[i::3]) for i in range(3)]))
    array = Array(out, "accessors")
    for i, (low, high) in enumerate(bounds):
        array.add({"bufferView": 0, "byteOffset": i * 36, "componentType": 5126, "count": 3,
                   "type": "VEC3", "min": low, "max": high})
    times = struct.pack("<2f", 0, 1)
    array.add({"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR",
               "min": [0.0], "max": [1.0]})
    array.add({"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"})
    array.close()
    return data, times, struct.pack("<6f", 0, 0, 0, 0, 1, 0)


def make_city(folder, blocks):
    rnd, houses = random.Random(3), 100
    count = blocks * houses // 4
    materials = max(1, count // 3)
    with open(os.path.join(folder, "city.gltf"), "w", encoding="utf-8") as out:
        out.write("{\n" + json.dumps({"asset": ASSET, "extensionsUsed": USED, "scene": 0,
                                      "scenes": [{"nodes": [0]}]}, indent=2)[2:-2])
        city_nodes(out, rnd, blocks, houses)
        array = Array(out, "meshes")
        for i in range(count):
            array.add({"name": f"house type {i}", "primitives": [
                {"attributes": {"POSITION": i}, "material": i % materials, "mode": 4}]})
        array.close()
        array = Array(out, "materials")
        for i in range(materials):
            array.add(material(rnd, i))
        array.close()
        array = Array(out, "animations")
        array.add({"name": "rise", "samplers": [{"input": count, "output": count + 1}],
                   "channels": [{"sampler": 0, "target": {
                       "node": blocks + 1 + i, "path": "translation"}} for i in range(count)]})
        array.close()
        parts = city_geometry(out, rnd, count)
        offsets = [0, len(parts[0]), len(parts[0]) + len(parts[1])]
        views = [{"buffer": 0, "byteOffset": at, "byteLength": len(part)}
                 for at, part in zip(offsets, parts)]
        views[0].update(byteStride=12, target=34962)
        total = sum(len(part) for part in parts)
        out.write(",\n" + json.dumps({"bufferViews": views, "buffers": [
            {"byteLength": total, "uri": "city.bin"}]}, indent=2)[2:-2] + "\n}\n")
    with open(os.path.join(folder, "city.bin"), "wb") as out:
        out.write(b"".join(parts))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--only", default="batch,city")
    parser.add_argument("--files", type=int, default=1000)
    parser.add_argument("--blocks", type=int, default=1500)
    options = parser.parse_args()
    for name in options.only.split(","):
        folder = os.path.join(options.folder, name)
        os.makedirs(folder, exist_ok=True)
        if name == "batch":
            make_batch(folder, options.files)
        else:
            make_city(folder, options.blocks)


if __name__ == "__main__":
    main()

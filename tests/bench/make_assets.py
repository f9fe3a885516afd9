#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the benchmarks' workloads, the same bytes every time.

  make_assets.py FOLDER [--only batch,city,...] [--files N] [--blocks N] [--side N]

batch     1,000 small models of a few ten KB, half with the buffer inside, half with a .bin beside
city      one .gltf of some 70 MB of JSON: many nodes, meshes, materials and animation channels
terrain   one .glb of some 400 MB of plain geometry: 8 meshes with positions, normals, tangents,
          texture coordinates and indices
normals   two .glb of a million vertices: clean.glb, and bad.glb whose normals are all too long
statue    one .glb of 100,000 triangles with three textures of 1,024 texels a side, to be drawn
toy       one .glb of 4,000 triangles with one texture of 512 texels a side, to be drawn
helmet    one .glb of 70,000 vertices with five JPEG textures of 2,048 texels a side, to be drawn
many      200 .gltf as small as toy, each with its own shape, that share their texture
textures  one .glb of some 500 MB with 40 PNG images of 2,048 to 4,096 texels a side
tables    one .glb of some 100 MB of property tables: numbers with limits, enums, strings, arrays
legacy    200 models with a retired extension, each with its own map of 512 texels per side
"""
import argparse
import array
import base64
import json
import math
import os
import random
import struct
import zlib

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
    """One triangle per mesh, each with its own bounds."""
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


def write_glb(path, document, parts, lengths=None):
    """`parts` are views, in order; each is padded to four bytes. `lengths`, by part: of the view,
    where that is shorter. Then BIN begins at a multiple of 8."""
    at, views = 0, []
    for index, part in enumerate(parts):
        views.append({"buffer": 0, "byteOffset": at, "byteLength": lengths[index] if lengths else len(part)})
        at += len(part) + -len(part) % 4
    document.update(asset=ASSET, bufferViews=views, buffers=[{"byteLength": at}])
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4 if lengths is None else -(len(text) + 4) % 8)
    with open(path, "wb") as out:
        out.write(b"glTF" + struct.pack("<II", 2, 12 + 8 + len(text) + 8 + at))
        out.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", at, b"BIN\0"))
        for part in parts:
            out.write(part)
            out.write(b"\0" * (-len(part) % 4))


def table_columns(rows):
    """Property, members of its column, and views by their member: fixed widths first, strings last.
    Each view begins at a multiple of 8, as floor_tables.cpp expects."""
    rnd = random.Random(5)
    names = [word.encode() for word in ("Eiche", "Fichte", "Weißdorn", "Götterbaum", "樫の木", "Ahorn an der Straße")]

    def numbers(code, values):
        return array.array(code, values).tobytes()
    heights = [as_float32(rnd.uniform(1, 40)) for _ in range(1000)]
    yield "height", {"type": "SCALAR", "componentType": "FLOAT32"}, {"min": min(heights), "max": max(heights)}, {
        "values": numbers("f", (heights * (rows // 1000 + 1))[:rows])}
    areas = [rnd.uniform(1, 900) for _ in range(1000)]
    yield "area", {"type": "SCALAR", "componentType": "FLOAT64"}, {"min": min(areas), "max": max(areas)}, {
        "values": numbers("d", (areas * (rows // 1000 + 1))[:rows])}
    places = [as_float32(rnd.uniform(-900, 900)) for _ in range(3000)]
    yield "place", {"type": "VEC3", "componentType": "FLOAT32"}, {
        "min": [min(places[i::3]) for i in range(3)], "max": [max(places[i::3]) for i in range(3)]}, {
        "values": numbers("f", (places * (rows // 1000 + 1))[:rows * 3])}
    years = [rnd.randrange(-200, 2026) for _ in range(1000)]
    yield "year", {"type": "SCALAR", "componentType": "INT16"}, {"min": min(years), "max": max(years)}, {
        "values": numbers("h", (years * (rows // 1000 + 1))[:rows])}
    kinds = [rnd.randrange(0, 6) for _ in range(1000)]
    yield "kind", {"type": "ENUM", "enumType": "kind"}, {}, {
        "values": numbers("B", (kinds * (rows // 1000 + 1))[:rows])}
    starts = [0]
    for i in range(rows):
        starts.append(starts[-1] + i % 5)
    yield "girths", {"type": "SCALAR", "componentType": "FLOAT32", "array": True}, {}, {
        "arrayOffsets": numbers("I", starts),
        "values": numbers("f", (heights * (starts[-1] // 1000 + 1))[:starts[-1]])}
    chosen = [names[i] for i in kinds]
    ends = [0]
    for i in range(rows):
        ends.append(ends[-1] + len(chosen[i % 1000]))
    yield "name", {"type": "STRING"}, {}, {
        "stringOffsets": numbers("I", ends), "values": (b"".join(chosen) * (rows // 1000 + 1))[:ends[-1]]}


def make_tables(path, rows):
    properties, columns, parts = {}, {}, []
    for name, members, limits, views in table_columns(rows):
        properties[name] = members
        columns[name] = dict(limits)
        for member, content in views.items():
            columns[name][member] = len(parts)
            parts.append(content + b"\0" * (-len(content) % 8))
            columns[name][member + "Length"] = len(content)
    lengths = {}
    for column in columns.values():
        for member in ("values", "arrayOffsets", "stringOffsets"):
            if member in column:
                lengths[column[member]] = column.pop(member + "Length")
    kinds = [{"name": f"kind {i}", "value": i} for i in range(6)]
    document = {"extensionsUsed": ["EXT_structural_metadata"], "extensions": {"EXT_structural_metadata": {
        "schema": {"id": "trees", "classes": {"tree": {"properties": properties}},
                   "enums": {"kind": {"valueType": "UINT8", "values": kinds}}},
        "propertyTables": [{"class": "tree", "count": rows, "properties": columns}]}}}
    write_glb(path, document, parts, lengths)


def terrain_parts(side, normal):
    """Views and accessors of a plane of side x side vertices."""
    steps = [as_float32(i / (side - 1)) for i in range(side)]
    points, uvs, triangles = array.array("f"), array.array("f"), array.array("I")
    for y in steps:
        for x in steps:
            points.extend((x, 0.0, y))
            uvs.extend((x, y))
    for j in range(side - 1):
        for k in range(j * side, j * side + side - 1):
            triangles.extend((k, k + side, k + 1, k + 1, k + side, k + side + 1))
    count = side * side
    values = [(points, "VEC3", 5126, count, [0, 0, 0], [1, 0, 1]),
              (array.array("f", normal) * count, "VEC3", 5126, count, normal, normal),
              (array.array("f", (1, 0, 0, 1)) * count, "VEC4", 5126, count, [1, 0, 0, 1],
               [1, 0, 0, 1]),
              (uvs, "VEC2", 5126, count, [0, 0], [1, 1]),
              (triangles, "SCALAR", 5125, len(triangles), [0], [count - 1])]
    accessors = [{"bufferView": i, "componentType": component, "count": length, "type": kind,
                  "min": low, "max": high}
                 for i, (_, kind, component, length, low, high) in enumerate(values)]
    return [part.tobytes() for part, *_ in values], accessors


def make_terrain(path, side, meshes, normal=(0.0, 1.0, 0.0)):
    own, accessors = terrain_parts(side, [as_float32(v) for v in normal])
    document = {"scene": 0, "scenes": [{"nodes": list(range(meshes))}],
                "nodes": [{"mesh": i} for i in range(meshes)], "meshes": [], "accessors": []}
    for mesh in range(meshes):
        first = 5 * mesh
        document["accessors"] += [dict(a, bufferView=first + i) for i, a in enumerate(accessors)]
        document["meshes"].append({"primitives": [{"attributes": {
            "POSITION": first, "NORMAL": first + 1, "TANGENT": first + 2, "TEXCOORD_0": first + 3},
            "indices": first + 4}]})
    write_glb(path, document, own * meshes)


def png(size, seed, base=(96, 96, 96)):
    """An RGB image of size x size texels that packs as badly as a photograph: noise of four bits on
    a colour, which repeats only farther away than zlib looks."""
    rnd = random.Random(seed)
    rows = []
    for _ in range(64):
        row = bytearray(rnd.randbytes(3 * size))
        for channel, least in enumerate(base):
            four_bits = bytes(least + value % 16 for value in range(256))
            row[channel::3] = row[channel::3].translate(four_bits)
        rows.append(b"\0" + bytes(row))
    data = zlib.compress(b"".join(rows[y % 64] for y in range(size)), 1)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def statue_parts(rings):
    """Views and accessors of a ball with bumps, of four times `rings` squared triangles."""
    points, normals, uvs, triangles = (array.array(code) for code in "fffI")
    columns = 2 * rings
    for j in range(rings + 1):
        for i in range(columns + 1):
            down, turn = math.pi * j / rings, 2 * math.pi * i / columns
            x, y, z = (math.sin(down) * math.cos(turn), math.cos(down),
                       math.sin(down) * math.sin(turn))
            radius = 1 + 0.15 * math.sin(5 * turn) * math.sin(7 * down) * math.sin(down)
            points.extend((radius * x, radius * y, radius * z))
            normals.extend((x, y, z))
            uvs.extend((4 * i / columns, 2 * j / rings))
            if i < columns and j < rings:
                k = j * (columns + 1) + i
                triangles.extend((k, k + 1, k + columns + 1,
                                  k + 1, k + columns + 2, k + columns + 1))
    bounds = {"min": [min(points[c::3]) for c in range(3)],
              "max": [max(points[c::3]) for c in range(3)]}
    count = len(points) // 3
    accessors = [
        dict(bufferView=0, componentType=5126, count=count, type="VEC3", **bounds),
        dict(bufferView=1, componentType=5126, count=count, type="VEC3"),
        dict(bufferView=2, componentType=5126, count=count, type="VEC2"),
        dict(bufferView=3, componentType=5125, count=len(triangles), type="SCALAR")]
    return [part.tobytes() for part in (points, normals, uvs, triangles)], accessors


def drawn(accessors, images, kind, material):
    """The document of one mesh with one material."""
    return {"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "accessors": accessors,
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
                                        "indices": 3, "material": 0}]}],
            "images": [{"bufferView": 4 + i, "mimeType": kind} for i in range(images)],
            "textures": [{"source": i} for i in range(images)], "materials": [material]}


def make_statue(path, rings):
    parts, accessors = statue_parts(rings)
    colors = [(150, 110, 80), (20, 120, 0), (120, 120, 235)]
    images = [png(1024, i, base) for i, base in enumerate(colors)]
    write_glb(path, drawn(accessors, 3, "image/png", {
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                 "metallicRoughnessTexture": {"index": 1}},
        "normalTexture": {"index": 2}}), parts + images)


# Huffman tables whose codes have one length: DC coefficients by bits; AC coefficients by zeros before
# them and bits, the end of a block, and 16 zeros.
DC_TABLE = (4, list(range(12)))
AC_TABLE = (7, [0] + [run << 4 | bits for run in range(16) for bits in range(1, 6)])


class BitWriter:
    def __init__(self):
        self.value, self.bits = 0, 0

    def put(self, value, bits):
        self.value, self.bits = (self.value << bits) | value, self.bits + bits

    def put_number(self, table, run, number):
        size = abs(number).bit_length()
        self.put_symbol(table, run << 4 | size)
        self.put(number if number >= 0 else number + (1 << size) - 1, size)

    def put_symbol(self, table, symbol):
        self.put(table[1].index(symbol), table[0])

    def bytes(self):
        missing = -self.bits % 8
        data = (self.value << missing | (1 << missing) - 1).to_bytes((self.bits + missing) // 8, "big")
        return data.replace(b"\xff", b"\xff\0")


def jpeg_row(rnd, columns, base, detail):
    """A row of blocks of 16 x 16 texels, colours at half the resolution. Coefficients fall off with
    the frequency as in photographs."""
    out, before = BitWriter(), [0, 0, 0]
    for _ in range(columns):
        for component in (0, 0, 0, 0, 1, 2):
            spread = detail if component == 0 else detail // 3
            value = base[component] + rnd.randint(-spread, spread)
            out.put_number(DC_TABLE, 0, value - before[component])
            before[component], run = value, 0
            for frequency in range(1, 16):
                most = min(31, spread // (1 + frequency // 2))
                number = rnd.randint(-most, most) if rnd.random() < 0.5 else 0
                if number:
                    out.put_number(AC_TABLE, run, number)
                run = 0 if number else run + 1
            out.put_symbol(AC_TABLE, 0)
    return out.bytes()


def jpeg(size, seed, base, detail):
    """An image of three channels, compressed as cameras do (4:2:0) and about as well: `base` is its
    mean luma and chroma in steps of the quantisation, `detail` the greatest deviation."""
    def segment(marker, body):
        return struct.pack(">BBH", 0xFF, marker, len(body) + 2) + body

    columns = size // 16
    rnd = random.Random(seed)
    rows = [jpeg_row(rnd, columns, base, detail) for _ in range(16)]
    parts = [b"\xff\xd8", segment(0xDB, b"\0" + bytes([4] * 64)),
             segment(0xC0, struct.pack(">BHHB", 8, size, size, 3) +
                     b"\1\x22\0\2\x11\0\3\x11\0"),
             segment(0xDD, struct.pack(">H", columns))]
    for kind, (length, symbols) in ((0x00, DC_TABLE), (0x10, AC_TABLE)):
        counts = [len(symbols) if bits == length else 0 for bits in range(1, 17)]
        parts.append(segment(0xC4, bytes([kind, *counts, *symbols])))
    parts.append(segment(0xDA, b"\3\1\0\2\0\3\0\0\x3f\0"))
    for row in range(columns):
        if row:
            parts.append(bytes([0xFF, 0xD0 + (row - 1) % 8]))
        parts.append(rows[row % 16])
    return b"".join(parts) + b"\xff\xd9"


def make_toy(path):
    parts, accessors = statue_parts(32)
    write_glb(path, drawn(accessors, 1, "image/png", {"pbrMetallicRoughness": {
        "baseColorTexture": {"index": 0}, "metallicFactor": 0}}),
        parts + [png(512, 0, (220, 180, 40))])


def make_many(folder, count):
    with open(os.path.join(folder, "paint.png"), "wb") as file:
        file.write(png(512, 0, (220, 180, 40)))
    for i in range(count):
        parts, accessors = statue_parts(8 + i % 25)
        at, views = 0, []
        for part in parts:
            views.append({"buffer": 0, "byteOffset": at, "byteLength": len(part)})
            at += len(part)
        document = drawn(accessors, 1, "image/png", {"pbrMetallicRoughness": {
            "baseColorTexture": {"index": 0}, "metallicFactor": i % 2,
            "roughnessFactor": (i % 10 + 1) / 10}})
        document.update(asset=ASSET, images=[{"uri": "paint.png"}], bufferViews=views, buffers=[{
            "byteLength": at, "uri": "data:application/octet-stream;base64," +
            base64.b64encode(b"".join(parts)).decode()}])
        with open(os.path.join(folder, f"toy{i:03d}.gltf"), "w", encoding="utf-8") as file:
            json.dump(document, file)


def make_helmet(path):
    parts, accessors = statue_parts(186)
    looks = [((10, 12, -8), 60), ((-40, 10, -60), 30), ((30, 90, 0), 24), ((200, 0, 0), 40),
             ((-240, 0, 0), 12)]
    images = [jpeg(2048, i, base, detail) for i, (base, detail) in enumerate(looks)]
    write_glb(path, drawn(accessors, 5, "image/jpeg", {
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                 "metallicRoughnessTexture": {"index": 1}},
        "normalTexture": {"index": 2}, "occlusionTexture": {"index": 3},
        "emissiveTexture": {"index": 4}, "emissiveFactor": [1, 1, 1]}), parts + images)


def make_textures(path, count):
    images = [png(2048 if i % 4 else 4096, i) for i in range(count)]
    document = {"images": [{"bufferView": i, "mimeType": "image/png"} for i in range(count)],
                "textures": [{"source": i} for i in range(count)],
                "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}}
                              for i in range(count)]}
    write_glb(path, document, images)


def make_legacy(folder, count):
    for i in range(count):
        with open(os.path.join(folder, f"m{i:04d}.png"), "wb") as file:
            file.write(png(512, i))
        document = {"asset": ASSET, "extensionsUsed": ["KHR_materials_translucency"],
                    "images": [{"uri": f"m{i:04d}.png"}], "textures": [{"source": 0}],
                    "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.4, 0.7, 0.2, 1]},
                                   "extensions": {"KHR_materials_translucency": {
                                       "translucencyFactor": 0.5,
                                       "translucencyTexture": {"index": 0}}}}]}
        with open(os.path.join(folder, f"m{i:04d}.gltf"), "w", encoding="utf-8") as file:
            json.dump(document, file, indent=2)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument(
        "--only",
        default="batch,city,terrain,normals,statue,toy,helmet,many,textures,tables,legacy")
    parser.add_argument("--files", type=int, default=1000)
    parser.add_argument("--blocks", type=int, default=1500)
    parser.add_argument("--side", type=int, default=800, help="vertices along a side of a terrain")
    parser.add_argument("--rows", type=int, default=1900000, help="of the property table")
    options = parser.parse_args()
    for name in options.only.split(","):
        folder = os.path.join(options.folder, name)
        os.makedirs(folder, exist_ok=True)
        if name == "batch":
            make_batch(folder, options.files)
        elif name == "city":
            make_city(folder, options.blocks)
        elif name == "terrain":
            make_terrain(os.path.join(folder, "terrain.glb"), options.side, 8)
        elif name == "normals":
            make_terrain(os.path.join(folder, "clean.glb"), 1000, 1)
            make_terrain(os.path.join(folder, "bad.glb"), 1000, 1, (0.0, 1.5, 0.0))
        elif name == "statue":
            make_statue(os.path.join(folder, "statue.glb"), 158)
        elif name == "tables":
            make_tables(os.path.join(folder, "tables.glb"), options.rows)
        elif name == "toy":
            make_toy(os.path.join(folder, "toy.glb"))
        elif name == "helmet":
            make_helmet(os.path.join(folder, "helmet.glb"))
        elif name == "many":
            make_many(folder, 200)
        elif name == "legacy":
            make_legacy(folder, 200)
        else:
            make_textures(os.path.join(folder, "textures.glb"), 40)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: Apache-2.0
"""Reads an asset with NumPy, independent of gltfx: accessors, nodes, skins, instances."""
import base64
import json
import pathlib
import struct
import urllib.parse

import numpy as np

TYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


class Unreadable(Exception):
    """The asset is compressed, broken, or of a kind that this reader does not know."""


def local_matrix(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), float) / np.linalg.norm(
        node.get("rotation", (0, 0, 0, 1)))
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]) * np.array(
            node.get("scale", (1, 1, 1)), float)[None]
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


class Asset:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        data = self.path.read_bytes()
        self.bin = None
        if data[:4] == b"glTF":
            at = 12
            while at + 8 <= len(data):
                size, kind = struct.unpack_from("<I4s", data, at)
                chunk = data[at + 8:at + 8 + size]
                if kind == b"JSON":
                    self.json = json.loads(chunk)
                elif kind == b"BIN\0":
                    self.bin = chunk
                at += 8 + size
        else:
            self.json = json.loads(data)
        self.buffers = {}

    def list(self, name):
        return self.json.get(name, [])

    def resource(self, uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return (self.path.parent / urllib.parse.unquote(uri)).read_bytes()

    def view(self, index):
        view = self.json["bufferViews"][index]
        if any("compression" in name for name in view.get("extensions", {})):
            raise Unreadable("a compressed view")
        number = view["buffer"]
        if number not in self.buffers:
            uri = self.json["buffers"][number].get("uri")
            self.buffers[number] = self.resource(uri) if uri else self.bin
        begin = view.get("byteOffset", 0)
        return self.buffers[number][begin:begin + view["byteLength"]]

    def stored(self, described, view, count, width, stride=None):
        kind = np.dtype(TYPES[described["componentType"]])
        size = kind.itemsize * width
        offsets = described.get("byteOffset", 0) + np.arange(count)[:, None] * (stride or size)
        data = np.frombuffer(self.view(view), np.uint8)
        return data[offsets + np.arange(size)[None]].copy().view(kind).reshape(count, width)

    def integers(self, index):
        """The elements as they are stored."""
        described = self.json["accessors"][index]
        if described["componentType"] not in TYPES or "extensions" in described:
            raise Unreadable("a component type of an extension")
        count, width = described["count"], WIDTHS[described["type"]]
        view = described.get("bufferView")
        if view is None:
            values = np.zeros((count, width), TYPES[described["componentType"]])
        else:
            values = self.stored(described, view, count, width,
                                 self.json["bufferViews"][view].get("byteStride"))
        if "sparse" in described:
            sparse = described["sparse"]
            at = self.stored(sparse["indices"], sparse["indices"]["bufferView"], sparse["count"], 1)[:, 0]
            values[at] = self.stored({**sparse["values"], "componentType": described["componentType"]},
                                     sparse["values"]["bufferView"], sparse["count"], width)
        return values

    def numbers(self, index):
        values = self.integers(index)
        if self.json["accessors"][index].get("normalized") and values.dtype.kind in "iu":
            return np.maximum(values.astype(float) / np.iinfo(values.dtype).max, -1)
        return values.astype(float)

    def corners(self, primitive, count):
        """The vertices that corners use."""
        if "extensions" in primitive and any("compression" in name for name in primitive["extensions"]):
            raise Unreadable("a compressed primitive")
        if "indices" not in primitive:
            return np.arange(count)
        indices = np.unique(self.integers(primitive["indices"])[:, 0].astype(np.int64))
        return indices[indices < count]

    def world(self):
        """The transforms of all nodes, by index, and which the default scene reaches."""
        matrices, seen = {}, set()
        nodes = self.list("nodes")
        children = {child for node in nodes for child in node.get("children", [])}
        scenes = self.list("scenes")
        roots = [i for i in range(len(nodes)) if i not in children]
        drawn = scenes[self.json.get("scene", 0)].get("nodes", []) if scenes else roots
        for start, in_scene in ((drawn, True), (roots, False)):
            open_nodes = [(i, np.eye(4)) for i in start]
            while open_nodes:
                i, above = open_nodes.pop()
                if i in matrices:
                    continue
                matrices[i] = above @ local_matrix(nodes[i])
                if in_scene:
                    seen.add(i)
                open_nodes += [(child, matrices[i]) for child in nodes[i].get("children", [])]
        return matrices, seen

    def joints(self, index, world):
        skin = self.json["skins"][index]
        matrices = np.array([world[joint] for joint in skin["joints"]])
        if "inverseBindMatrices" not in skin:
            return matrices
        inverse = self.numbers(skin["inverseBindMatrices"])[:len(matrices)]
        return matrices @ inverse.reshape(-1, 4, 4).transpose(0, 2, 1)

    def instances(self, node):
        attributes = node.get("extensions", {}).get("EXT_mesh_gpu_instancing", {}).get("attributes")
        if attributes is None:
            return [np.eye(4)]
        values = {name.lower(): self.numbers(attributes[name])
                  for name in ("TRANSLATION", "ROTATION", "SCALE") if name in attributes}
        if not values:
            return [np.eye(4)]
        return [local_matrix({name: each[i] for name, each in values.items()})
                for i in range(len(next(iter(values.values()))))]

    def longest_side(self):
        """Of all images, in texels."""
        sides = [1024] if not self.list("images") else [1]
        for image in self.list("images"):
            data = self.resource(image["uri"]) if "uri" in image else self.view(image["bufferView"])
            sides.append(max(image_size(bytes(data))))
        return max(sides)


def image_size(data):
    if data[:8] == b"\x89PNG\r\n\x1a\n":
        return struct.unpack_from(">II", data, 16)
    if data[:2] == b"\xff\xd8":
        at = 2
        while at + 9 < len(data):
            marker, size = data[at + 1], struct.unpack_from(">H", data, at + 2)[0]
            if 0xC0 <= marker <= 0xCF and marker not in (0xC4, 0xC8, 0xCC):
                return struct.unpack_from(">HH", data, at + 5)[::-1]
            at += 2 + size
    raise Unreadable("an image that is neither PNG nor JPEG")

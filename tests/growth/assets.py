# SPDX-License-Identifier: Apache-2.0
"""The asset that every construct is put into: a triangle with one object of each kind."""
import base64
import copy
import json
import struct
import zlib


def _png():
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"\0\xff\x80\x40\xff")) + chunk(b"IEND", b""))


def data_uri(data, kind="application/octet-stream"):
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


PNG_URI = data_uri(_png(), "image/png")

_IDENTITY = struct.pack("<16f", *[float(i % 5 == 0) for i in range(16)])
# Accessors by use; each has its own view.
_PARTS = [
    ("VEC3", 5126, 3, struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0), {"min": [0, 0, 0], "max": [1, 1, 0]}),
    ("VEC3", 5126, 3, struct.pack("<9f", *[0, 0, 1] * 3), {}),
    ("VEC2", 5126, 3, struct.pack("<6f", 0, 0, 1, 0, 0, 1), {}),
    ("SCALAR", 5126, 2, struct.pack("<2f", 0, 1), {"min": [0], "max": [1]}),
    ("VEC4", 5126, 2, struct.pack("<8f", *[0, 0, 0, 1] * 2), {}),
    ("MAT4", 5126, 1, _IDENTITY, {}),
    ("VEC4", 5121, 3, bytes([0, 0, 0, 0] * 3), {}),
    ("VEC4", 5126, 3, struct.pack("<12f", *[1, 0, 0, 0] * 3), {}),
    ("SCALAR", 5125, 3, struct.pack("<3I", 0, 1, 2), {}),
]
POSITION, NORMAL, TEXCOORD, TIMES, ROTATIONS, MATRIX, JOINTS, WEIGHTS, INDICES = range(len(_PARTS))


def base():
    """A fresh asset. Its material is a legacy one, so that an upgrade has something to do."""
    data, views, accessors = b"", [], []
    for kind, component, count, content, bounds in _PARTS:
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(content)})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": count,
                          "type": kind, **bounds})
        data += content
    return {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_translucency"],
        "buffers": [{"uri": data_uri(data), "byteLength": len(data)}],
        "bufferViews": views,
        "accessors": accessors,
        "images": [{"uri": PNG_URI}],
        "samplers": [{}],
        "textures": [{"source": 0, "sampler": 0}],
        "materials": [{
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
            "extensions": {"KHR_materials_translucency": {"translucencyFactor": 0.5}},
        }],
        "meshes": [{"primitives": [{
            "attributes": {"POSITION": POSITION, "NORMAL": NORMAL, "TEXCOORD_0": TEXCOORD},
            "material": 0,
        }]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "skins": [{"joints": [0]}],
        "animations": [animation(0)],
        "nodes": [{"mesh": 0}, {"camera": 0}],
        "scenes": [{"nodes": [0, 1]}],
        "scene": 0,
    }


def animation(node):
    return {"samplers": [{"input": TIMES, "output": ROTATIONS}],
            "channels": [{"sampler": 0, "target": {"node": node, "path": "rotation"}}]}


# A new object of each kind that extensions sit on.
FRESH = {
    "node": ("nodes", lambda: {}),
    "material": ("materials", lambda: {}),
    "mesh": ("meshes", lambda: {"primitives": [{"attributes": {"POSITION": POSITION}}]}),
    "scene": ("scenes", lambda: {"nodes": [0]}),
    "texture": ("textures", lambda: {"source": 0}),
    "image": ("images", lambda: {"uri": PNG_URI}),
    "buffer": ("buffers", lambda: {"uri": data_uri(bytes(4)), "byteLength": 4}),
    "bufferView": ("bufferViews", lambda: {"buffer": 0, "byteLength": 4}),
    "accessor": ("accessors", lambda: {"componentType": 5126, "type": "VEC3", "count": 3}),
    "animation": ("animations", lambda: animation(0)),
    "camera": ("cameras", lambda: {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}),
    "skin": ("skins", lambda: {"joints": [0]}),
    "sampler": ("samplers", lambda: {}),
}


def link(asset, first):
    """Draws the appended objects: a node for each mesh and skin, all nodes in the scene. `first` is
    the base asset."""
    nodes = asset["nodes"]
    for mesh in range(len(first["meshes"]), len(asset["meshes"])):
        nodes.append({"mesh": mesh})
    for skin in range(len(first["skins"]), len(asset["skins"])):
        nodes.append({"mesh": 0, "skin": skin})
    asset["scenes"][0]["nodes"] = list(range(len(nodes)))
    return asset


def text_of(asset):
    return json.dumps(asset, separators=(",", ":")).encode()


def merged(asset, more):
    """The asset with the root members of `more`: arrays are appended to existing ones."""
    asset = copy.copy(asset)
    for name, value in more.items():
        old = asset.get(name)
        if isinstance(old, list) and isinstance(value, list):
            asset[name] = old + value
        elif isinstance(old, dict) and isinstance(value, dict):
            asset[name] = {**old, **value}
        else:
            asset[name] = value
    return asset

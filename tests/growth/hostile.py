# SPDX-License-Identifier: Apache-2.0
"""Assets that need much memory for their size: dense text, large counts, shared data."""
import struct

import by_hand
from assets import base, data_uri, merged, text_of

LARGE = 24 << 20  # bytes of those cases that are all text


def filled(before, item, after):
    """Text of about LARGE bytes: the base asset with a member of many items."""
    return by_hand.raw(before + ",".join([item] * (LARGE // (len(item) + 1))) + after)


def members(key):
    count = LARGE // (len(key) + 10)
    return by_hand.raw(",".join(f'"{key}{i}":0' for i in range(count)))


def counts(n):
    """An accessor that declares very many elements."""
    return by_hand.finished({"accessors": [{"componentType": 5126, "type": "VEC3", "count": n}],
                             "meshes": [{"primitives": [{"attributes": {"POSITION": 9}}]}]})


def sparse_counts(n):
    one = {"componentType": 5126, "type": "VEC3", "count": n, "sparse": {
        "count": 1, "indices": {"bufferView": 8, "componentType": 5125}, "values": {"bufferView": 0}}}
    return by_hand.finished({"accessors": [one] * 1000, "meshes": [{"primitives": [
        {"attributes": {"POSITION": 9 + i}} for i in range(1000)]}]})


def shared_vertices(vertices, uses):
    data = struct.pack("<3f", 0.5, 1, 2) * vertices
    return by_hand.finished({
        "buffers": [{"uri": data_uri(data), "byteLength": len(data)}],
        "bufferViews": [{"buffer": 1, "byteLength": len(data)}],
        "accessors": [{"bufferView": 9, "componentType": 5126, "type": "VEC3", "count": vertices}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 9}, "mode": mode % 7}]}
                   for mode in range(uses)]})


def meshopt(count):
    """A view that declares a thousand times its bytes when unpacked."""
    return text_of(merged(base(), {
        "extensionsUsed": ["EXT_meshopt_compression"],
        "buffers": [{"byteLength": count * 16}],
        "bufferViews": [{"buffer": 1, "byteLength": count * 16, "byteStride": 16, "extensions": {
            "EXT_meshopt_compression": {"buffer": 0, "byteLength": 60, "byteStride": 16,
                                        "count": count, "mode": "ATTRIBUTES"}}}]}))


def large_image(width, height):
    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + b"IHDR" + head + bytes(4)
    return by_hand.finished({"images": [{"uri": data_uri(png + bytes(100), "image/png")}],
                             "textures": [{"source": 1}],
                             "materials": [{"emissiveTexture": {"index": 1}}]})


def draco(n):
    """Streams that are none, for a primitive each."""
    drawn = {"attributes": {"POSITION": 0}, "extensions": {
        "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}
    return by_hand.finished({"meshes": [{"primitives": [drawn] * n}]},
                            ["KHR_draco_mesh_compression"])


CASES = {
    "empty objects": lambda: filled('"extras":[', "{}", "]"),
    "empty arrays": lambda: filled('"extras":[', "[]", "]"),
    "empty strings": lambda: filled('"extras":[', '""', "]"),
    "words": lambda: filled('"extras":[', "null", "]"),
    "small members": lambda: filled('"extras":[', '{"":[]}', "]"),
    "numbers": lambda: filled('"extras":[', "1", "]"),
    "pairs of numbers": lambda: filled('"extras":[', "[1,1]", "]"),
    "many members": lambda: members("k"),
    "members with long names": lambda: members("k" * 100),
    "empty nodes": lambda: filled('"nodes":[', "{}", "]"),
    "empty root objects": lambda: by_hand.raw(",".join(
        f'"{name}":[' + ",".join(["{}"] * (LARGE // 60)) + "]" for name in (
            "accessors", "bufferViews", "images", "materials", "meshes", "nodes", "textures"))),
    "findings with a place each": lambda: filled('"nodes":[', '{"mesh":-1}', "]"),
    "names that are not known": lambda: filled('"extensionsUsed":[', '"A"', "]"),
    "a string of escapes": lambda: by_hand.raw('"extras":"' + "\\u0041" * (LARGE // 6) + '"'),
    "a string of zeros in a GLB": lambda: by_hand.glb(bytes(LARGE)),
    "text that is cut": lambda: by_hand.raw('"extras":[' + "[[]," * (LARGE // 4))[:-1],
    "four billion elements": lambda: counts(4294967295),
    "sparse ones among billions": lambda: sparse_counts(4294967295),
    "vertices that are drawn often": lambda: shared_vertices(100000, 2000),
    "meshopt that swells": lambda: meshopt(100000000),
    "an image of a billion pixels": lambda: large_image(32768, 32768),
    "an image that is wide": lambda: large_image(2147483647, 1),
    "streams of Draco that are none": lambda: draco(10000),
    "nodes times primitives": lambda: by_hand.primitives_in_nodes(1000000),
    "targets times primitives": lambda: by_hand.targets_by_primitives(1000000),
    "joint sets": lambda: by_hand.joint_sets(100000),
    "a deep tree": lambda: by_hand.deep_nodes(300000),
    "instances": lambda: by_hand.instances(300000),
    "textures of one image": lambda: by_hand.CONSTRUCTS["textures of one image"](200000),
    "levels of a KTX2 image": lambda: by_hand.ktx2_levels(1000000),
}

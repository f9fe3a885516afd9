# SPDX-License-Identifier: Apache-2.0
"""For each rule with a fix, assets with n findings: the bad example of its page, repeated."""
import base64
import copy
import functools
import glob
import json
import os
import re
import struct
import subprocess
import tempfile

from assets import base, data_uri, merged, text_of
from by_hand import finished, raw

# A file of any size has one.
ONE_IN_A_FILE = {"BUFFER_GLB_CHUNK_TOO_BIG", "DEFAULT_SCENE_MISSING", "GLB_BIN_PADDING", "GLB_CHUNK_LENGTH_UNALIGNED", "GLB_CHUNK_TOO_BIG",
                 "GLB_CHUNK_TYPE_NUMBER", "GLB_EXTRA_DATA", "GLB_JSON_PADDING", "GLB_LENGTH_MISMATCH",
                 "JSON_BYTE_ORDER_MARK", "JSON_INVALID_UTF8"}
# A report lists the first of them, or one for all objects of an extension.
TOLD_ONCE = {"BOUNDING_VOLUME_MISSES_POSES", "JSON_DUPLICATE_KEY", "JSON_TRAILING_COMMA", "JSON_MISSING_COMMA", "EXTENSION_NAME_MISSPELT",
             "EXTENSION_REQUIRED_WITH_FALLBACK", "EXTENSION_SHOULD_BE_REQUIRED", "EXTENSION_UNUSED", "NORMALS_AGAINST_WINDING",
             "SURFACE_INSIDE_OUT"}


# Each member that refers to an element of a root array, and to which.
REFERENCES = {"mesh": "meshes", "material": "materials", "indices": "accessors", "bufferView": "bufferViews",
              "buffer": "buffers", "input": "accessors", "output": "accessors", "node": "nodes", "children": "nodes",
              "nodes": "nodes", "attributes": "accessors", "targets": "accessors", "shape": "shapes"}
# Reported once for objects that share data: the whole example is repeated.
WHOLE = {"ANIMATION_ROTATION_FLIPS", "ANIMATION_TANGENTS_MOVE", "BOUNDING_VOLUME_MISSES_POSES",
         "MORPH_TARGET_NAME_REPEATED", "NORMALS_AGAINST_WINDING", "SURFACE_INSIDE_OUT"}


def shifted(value, by, array=None):
    """The value with each reference moved by the number of elements in its array."""
    if isinstance(value, dict):
        return {key: shifted(one, by, REFERENCES.get(key, array if isinstance(one, int) else None))
                for key, one in value.items()}
    if isinstance(value, list):
        return [shifted(one, by, array) for one in value]
    return value + by[array] if array and isinstance(value, int) else value


def whole_assets(document, n):
    """The asset n times in one scene, side by side."""
    arrays = {key: len(value) for key, value in document.items() if isinstance(value, list) and key != "scenes"}
    joined = copy.deepcopy(document)
    for i in range(1, n):
        by = {key: i * length for key, length in arrays.items()}
        for key in arrays:
            joined[key] += [shifted(one, by) for one in document[key]]
        for node in joined["nodes"][-arrays["nodes"]:]:
            node["translation"] = [10 * i, 0, 0]
        joined["scenes"][0]["nodes"] += shifted(document["scenes"][0]["nodes"], by, "nodes")
    return text_of(joined)


def repeated_members(text):
    return lambda n: raw('"extras":[' + ",".join([text] * n) + "]")


def views_of_positions(n):
    asset = base()
    first = len(asset["bufferViews"])
    asset["bufferViews"] += [{"buffer": 0, "byteLength": 36} for _ in range(n)]
    accessors = len(asset["accessors"])
    asset["accessors"] += [{**asset["accessors"][0], "bufferView": first + i} for i in range(n)]
    asset["meshes"][0]["primitives"] += [{"attributes": {"POSITION": accessors + i}} for i in range(n)]
    return text_of(asset)


def weights_of_meshes(n):
    mesh = {"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}], "weights": [0]}
    return text_of(merged(base(), {"meshes": [mesh] * n, "nodes": [{"mesh": 1 + i, "weights": [1]} for i in range(n)]}))


def materials_of(name, value):
    return lambda n: finished({"materials": [{"extensions": {name: value}} for _ in range(n)]}, [name])


# Where the example shows it in an object that a file has once, or the text cannot be read.
BY_HAND = {
    "BUFFER_VIEW_TARGET_MISSING": views_of_positions,
    "EMPTY_ENTITY": lambda n: finished({"nodes": [{"children": []} for _ in range(n)]}),
    "EXTENSION_NAME_MISSPELT": materials_of("KHR_material_unlit", {}),
    "INVALID_URI": lambda n: finished({"images": [{"uri": ".\\large.bin"}] * n}),
    "JSON_DUPLICATE_KEY": repeated_members('{"a":1,"a":1}'),
    "JSON_MISSING_COMMA": repeated_members("[1 2]"),
    "JSON_TRAILING_COMMA": repeated_members('{"a":1,}'),
    "PROPERTY_RENAMED": materials_of("KHR_materials_volume_scatter", {"multiscatterColor": [1, 1, 1]}),
    "UNDECLARED_EXTENSION": lambda n: finished({"materials": [{"extensions": {"KHR_materials_unlit": {}}}] * n}),
    "UNRESOLVED_REFERENCE": lambda n: finished({"nodes": [{"mesh": 9 + i} for i in range(n)]}),
    "UNUSED_MESH_WEIGHTS": weights_of_meshes,
}
FORMS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
COUNTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def pages(schema):
    """(code, whether the fix is safe, bad example) of each rule with a fix."""
    for path in sorted(glob.glob(os.path.join(schema, "rules", "*.md"))):
        with open(path, encoding="utf-8") as file:
            page = file.read()
        kind = re.search(r"^fix: (safe|unsafe)$", page, re.M)
        if kind:
            bad = re.search(r"^## Bad\n\n```\w+\n(.*?)\n```", page, re.M | re.S)
            yield os.path.basename(path)[:-3], kind[1] == "safe", bad[1]


def findings(program, code, text):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.gltf")
        with open(path, "wb") as file:
            file.write(text)
        with open(os.path.join(folder, "large.bin"), "wb") as file:
            file.write(bytes(20000))
        done = subprocess.run([program, "validate", path, "--isolated", "--profile", "strict", "--select", code,
                               "--format", "json", "--fail-on", "never"], capture_output=True, check=True)
    return json.loads(done.stdout)["files"][0]["findings"]


def resolved(document, steps):
    for step in steps:
        document = document[int(step) if isinstance(document, list) else step]
    return document


def repeat(document, pointer, n):
    """More of the innermost element of an array that a pointer leads to or through; nothing if there is none."""
    steps = pointer.split("/")[1:]
    for end in range(len(steps), 0, -1):
        array = resolved(document, steps[:end - 1])
        if isinstance(array, list):
            document = copy.deepcopy(document)
            resolved(document, steps[:end - 1]).extend([array[int(steps[end - 1])]] * (n - 1))
            return text_of(document)
    return None


def accessor_at(document, pointer):
    """The accessor that a finding is about, or None."""
    steps = pointer.split("/")[1:]
    if steps[0] == "accessors":
        return int(steps[1])
    if steps[-1] == "sampler":
        samplers = document["animations"][int(steps[1])]["samplers"]
        return samplers[resolved(document, steps)]["output"]
    return resolved(document, steps) if "attributes" in steps else None


def more_elements(document, index, n):
    """An accessor with n times its elements; None where they are not its own, packed and in a data URI."""
    accessor = document["accessors"][index]
    if "sparse" in accessor or accessor.get("bufferView") is None:
        return None
    view = document["bufferViews"][accessor["bufferView"]]
    uri = document["buffers"][view["buffer"]].get("uri", "")
    if not uri.startswith("data:"):
        return None
    size = struct.calcsize(FORMS[accessor["componentType"]]) * COUNTS[accessor["type"]] * accessor["count"]
    at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    data = base64.b64decode(uri.split(",", 1)[1])[at:at + size] * n
    document = copy.deepcopy(document)
    document["buffers"].append({"uri": data_uri(data), "byteLength": len(data)})
    document["bufferViews"].append({"buffer": len(document["buffers"]) - 1, "byteLength": len(data)})
    document["accessors"][index].update(
        {"bufferView": len(document["bufferViews"]) - 1, "byteOffset": 0, "count": n * accessor["count"]})
    return text_of(document)


def build_of(program, code, bad):
    """(build, build of elements or None); the Error says why there is none."""
    if code in BY_HAND:
        return BY_HAND[code], None
    document = json.loads(bad)
    if code in WHOLE:
        return functools.partial(whole_assets, document), None
    pointer = findings(program, code, bad.encode())[0]["pointer"]
    index = accessor_at(document, pointer) if code not in TOLD_ONCE else None
    by_elements = None
    if index is not None and more_elements(document, index, 2):
        by_elements = functools.partial(more_elements, document, index)
    if repeat(document, pointer, 1) is None:
        raise ValueError(f"{code}: {pointer!r} leads through no array; add it to BY_HAND")
    return functools.partial(repeat, document, pointer), by_elements


def roots_that_are_children(n):
    """Each node but the first is a root of the scene and a child of the one before."""
    return text_of(merged(base(), {
        "nodes": [{"children": [3 + i]} for i in range(n)] + [{}], "scenes": [{"nodes": list(range(3, n + 3))}]}))


def constructs(program, schema):
    """By name: (code, whether the fix is safe, build). One of each code has as many findings as are asked for, or one
    about as many elements."""
    found = {"children among roots": ("SCENE_NON_ROOT_NODE", True, roots_that_are_children)}
    for code, safe, bad in pages(schema):
        if code in ONE_IN_A_FILE:
            continue
        build, by_elements = build_of(program, code, bad)
        many = sum(one.get("count", 1) for one in findings(program, code, build(20)))
        if many >= 20 or code in TOLD_ONCE:
            found[code] = (code, safe, build)
        if by_elements and findings(program, code, by_elements(20)):
            found[f"{code}, elements"] = (code, safe, by_elements)
        if not any(name.split(",")[0] == code for name in found):
            raise ValueError(f"{code}: {many} findings of 20; add it to BY_HAND")
    return found

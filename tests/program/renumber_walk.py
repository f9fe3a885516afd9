#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Deletes every deletable object of assets, one run each, and checks the rest by an independent walk.

    tests/program/renumber_walk.py build/dev/bin/gltfx FOLDER...   [--jobs N] [--most N] [--groups N]

Every object of a copy of the asset gets a mark in its extras. After `gltfx edit --delete ... --cascade`
each object that is left has the same content as before, and each of its references leads to the
object with the same mark as before. The members that are references are listed here, written from the texts of
glTF and of the extensions, and not read from the schema files of gltfx. An object that is gone was
asked for, or referred to something that is gone. The number of objects is printed; the exit code says
whether all is well.
"""
import argparse
import concurrent.futures
import copy
import functools
import json
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import urllib.parse

# Paths of members that are indices: '*' is any element or member. A target without '/' is a root array, one
# that begins with '.' a member of the object that the first part of the path names.
REFERENCES = """
scene scenes
scenes/*/nodes/* nodes
nodes/*/children/* nodes
nodes/*/camera cameras
nodes/*/mesh meshes
nodes/*/skin skins
skins/*/joints/* nodes
skins/*/skeleton nodes
skins/*/inverseBindMatrices accessors
meshes/*/primitives/*/attributes/* accessors
meshes/*/primitives/*/targets/*/* accessors
meshes/*/primitives/*/indices accessors
meshes/*/primitives/*/material materials
accessors/*/bufferView bufferViews
accessors/*/sparse/indices/bufferView bufferViews
accessors/*/sparse/values/bufferView bufferViews
bufferViews/*/buffer buffers
images/*/bufferView bufferViews
textures/*/source images
textures/*/sampler samplers
materials/*/pbrMetallicRoughness/baseColorTexture/index textures
materials/*/pbrMetallicRoughness/metallicRoughnessTexture/index textures
materials/*/normalTexture/index textures
materials/*/occlusionTexture/index textures
materials/*/emissiveTexture/index textures
materials/*/extensions/*/*/index textures
animations/*/channels/*/target/node nodes
animations/*/channels/*/sampler .animations/*/samplers
animations/*/samplers/*/input accessors
animations/*/samplers/*/output accessors
textures/*/extensions/EXT_texture_webp/source images
textures/*/extensions/EXT_texture_avif/source images
textures/*/extensions/KHR_texture_basisu/source images
textures/*/extensions/MSFT_texture_dds/source images
bufferViews/*/extensions/EXT_meshopt_compression/buffer buffers
bufferViews/*/extensions/KHR_meshopt_compression/buffer buffers
meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView bufferViews
meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/material materials
meshes/*/primitives/*/extensions/KHR_materials_variants/mappings/*/variants/* extensions/KHR_materials_variants/variants
nodes/*/extensions/KHR_lights_punctual/light extensions/KHR_lights_punctual/lights
nodes/*/extensions/EXT_mesh_gpu_instancing/attributes/* accessors
nodes/*/extensions/MSFT_lod/ids/* nodes
materials/*/extensions/MSFT_lod/ids/* materials
scenes/*/extensions/EXT_lights_image_based/light extensions/EXT_lights_image_based/lights
extensions/EXT_lights_image_based/lights/*/specularImages/*/* images
meshes/*/primitives/*/extensions/CESIUM_primitive_outline/indices accessors
meshes/*/primitives/*/extensions/EXT_mesh_features/featureIds/*/propertyTable extensions/EXT_structural_metadata/propertyTables
meshes/*/primitives/*/extensions/EXT_mesh_features/featureIds/*/texture/index textures
nodes/*/extensions/EXT_instance_features/featureIds/*/propertyTable extensions/EXT_structural_metadata/propertyTables
meshes/*/primitives/*/extensions/EXT_structural_metadata/propertyTextures/* extensions/EXT_structural_metadata/propertyTextures
meshes/*/primitives/*/extensions/EXT_structural_metadata/propertyAttributes/* extensions/EXT_structural_metadata/propertyAttributes
extensions/EXT_structural_metadata/propertyTables/*/properties/*/values bufferViews
extensions/EXT_structural_metadata/propertyTables/*/properties/*/arrayOffsets bufferViews
extensions/EXT_structural_metadata/propertyTables/*/properties/*/stringOffsets bufferViews
extensions/EXT_structural_metadata/propertyTextures/*/properties/*/index textures
extensions/KHR_xmp_json_ld/packet extensions/KHR_xmp_json_ld/packets
*/*/extensions/KHR_xmp_json_ld/packet extensions/KHR_xmp_json_ld/packets
asset/extensions/KHR_xmp_json_ld/packet extensions/KHR_xmp_json_ld/packets
extensions/KHR_techniques_webgl/programs/*/fragmentShader extensions/KHR_techniques_webgl/shaders
extensions/KHR_techniques_webgl/programs/*/vertexShader extensions/KHR_techniques_webgl/shaders
extensions/KHR_techniques_webgl/shaders/*/bufferView bufferViews
extensions/KHR_techniques_webgl/techniques/*/program extensions/KHR_techniques_webgl/programs
extensions/KHR_techniques_webgl/techniques/*/uniforms/*/node nodes
materials/*/extensions/KHR_techniques_webgl/technique extensions/KHR_techniques_webgl/techniques
materials/*/extensions/KHR_techniques_webgl/values/*/index textures
"""
# Members that are JSON pointers.
POINTERS = ("animations/*/channels/*/target/extensions/KHR_animation_pointer/pointer",)
# Positions that no index in the JSON counts: these elements must stay.
FIXED = ("skins/*/joints/*", "meshes/*/primitives/*/targets/*")
# Members that must not be there without another.
WITH = {"skin": "mesh", "weights": "mesh", "byteOffset": "bufferView"}


class Trie:
    def __init__(self):
        self.next, self.value = {}, None

    def add(self, path, value):
        node = self
        for step in path.split("/"):
            node = node.next.setdefault(step, Trie())
        node.value = value


TABLE = Trie()
for line in REFERENCES.split("\n"):
    if line.strip():
        TABLE.add(*line.split())
for line in POINTERS:
    TABLE.add(line, "pointer")


def references(document):
    """All references: (holder, key, path, list they lead into or "pointer")."""
    stack = [(document, (), [TABLE])]
    while stack:
        value, path, tries = stack.pop()
        items = value.items() if isinstance(value, dict) else enumerate(value)
        for key, child in items:
            if key == "extras":
                continue
            below = [t.next[k] for t in tries for k in (str(key), "*") if k in t.next]
            here = path + (key,)
            for trie in below:
                number = isinstance(child, (int, float)) and not isinstance(child, bool)
                if trie.value == "pointer" and isinstance(child, str):
                    yield value, key, here, "pointer"
                    break
                if trie.value and trie.value != "pointer" and number and child == int(child) and child >= 0:
                    yield value, key, here, target_list(document, here, trie.value)
                    break
            if isinstance(child, (dict, list)) and below:
                stack.append((child, here, below))


def target_list(document, path, target):
    if target.startswith("."):
        steps = [p if s == "*" else s for s, p in zip(target[1:].split("/"), path)]
        steps += target[1:].split("/")[len(steps):]
    else:
        steps = target.split("/")
    for step in steps:
        try:
            document = document[step]
        except (KeyError, IndexError, TypeError):
            return None
    return document if isinstance(document, list) else None


def leads_to(document, holder, key, kind):
    """The mark of the object of a reference; for a pointer, the marks on its path and its target."""
    if kind == "pointer":
        way, rest = [], document
        for step in holder[key].split("/")[1:]:
            step = step.replace("~1", "/").replace("~0", "~")
            try:
                rest = rest[int(step)] if isinstance(rest, list) else rest[step]
            except (KeyError, IndexError, ValueError, TypeError):
                way.append(step)
                break
            way.append(mark_of(rest) if isinstance(rest, dict) and mark_of(rest) is not None else
                       (step if not step.isdigit() else int(step)))
        return tuple(way)
    index = int(holder[key])
    if kind is None or index >= len(kind) or not isinstance(kind[index], dict):
        return None
    return mark_of(kind[index])


def mark_of(value):
    extras = value.get("extras")
    return extras.get("walk mark") if isinstance(extras, dict) else None


def objects(document):
    """All objects but those in extras, with their paths."""
    stack = [(document, ())]
    while stack:
        value, path = stack.pop()
        if isinstance(value, dict):
            yield value, path
        items = value.items() if isinstance(value, dict) else enumerate(value)
        for key, child in items:
            if isinstance(child, (dict, list)) and key != "extras":
                stack.append((child, path + (key,)))


def is_map(path):
    """Objects whose members are not properties: names of attributes, or of extensions."""
    return bool(path) and (path[-1] in ("attributes", "extensions", "properties", "uniforms", "values", "classes",
                                        "enums") or (len(path) > 1 and path[-2] == "targets"))


def marked(document):
    document = copy.deepcopy(document)
    count = 0
    for value, path in objects(document):
        if is_map(path) or not isinstance(value.get("extras", {}), dict):
            continue
        value.setdefault("extras", {})["walk mark"] = count
        count += 1
    return document


def deletable(document):
    """Pointers to elements of lists that hold objects."""
    found = []
    for value, path in objects(document):
        if path and isinstance(path[-1], int):
            found.append("/" + "/".join(str(s).replace("~", "~0").replace("/", "~1") for s in path))
    return sorted(found, key=lambda p: (p.count("/"), p))


class Walked:
    """The results of a walk over a document, shared by all checks."""

    def __init__(self, document):
        self.document = document
        marks = [(mark_of(v), v, p) for v, p in objects(document) if not is_map(p)]
        marks = [each for each in marks if each[0] is not None]
        self.marked = {mark: (value, path) for mark, value, path in marks}
        self.repeated = len(marks) != len(self.marked)
        self.references = [(place(document, path[:-1]), path, leads_to(document, holder, key, kind))
                           for holder, key, path, kind in references(document)]
        self.single, lists = {}, {}  # references by place; those in lists of indices by the list, in order
        for around, path, target in self.references:
            if isinstance(path[-1], int):
                lists.setdefault(around, {})[path[-1]] = target
            else:
                self.single[around + (path[-1],)] = target
        self.lists = {k: [v[i] for i in sorted(v)] for k, v in lists.items()}
        self.dangling = sum(1 for h, k, p, kind in references(document)
                            if kind != "pointer" and (kind is None or int(h[k]) >= len(kind)))

    @functools.cached_property
    def places(self):
        return {mark: place(self.document, path) for mark, (_, path) in self.marked.items()}

    @functools.cached_property
    def users(self):
        """By object, the marks that it refers to, itself or below."""
        users = {mark: set() for mark in self.marked}
        for _, path, target in self.references:
            marks = {t for t in target if t in self.marked} if isinstance(target, tuple) else {target}
            for owner in owners(self.document, path):
                users[owner] |= marks
        return users


def check(before, after, pointer):
    """The errors after the deletion of `pointer`, by the walk; empty: none."""
    wrong = []
    old, new = before.marked, after.marked
    if new.keys() - old.keys() or after.repeated:
        wrong.append("objects came from nowhere")
    steps = tuple(int(s) if s.isdigit() else s.replace("~1", "/").replace("~0", "~") for s in pointer.split("/")[1:])
    gone = old.keys() - new.keys()
    asked = {m for m, (v, p) in old.items() if p[:len(steps)] == steps}
    wrong += [f"{old[m][1]} is still there" for m in asked - gone]
    wrong += dangling(before, after)
    wrong += unlike(before, after)
    reason = with_reason(before.document, old, gone, asked, before.users)
    return wrong + [f"{old[m][1]} is gone without a reason" for m in gone - reason]


def is_within(value, marks):
    """A list of nothing but objects with these marks."""
    return isinstance(value, list) and bool(value) and all(isinstance(e, dict) and mark_of(e) in marks for e in value)


def with_reason(before, old, gone, asked, users):
    """Objects that were asked for, lie in one that went, refer to one, or have lost a whole list."""
    reason, left = set(asked), gone - asked
    while True:
        found = {m for m in left if users[m] & reason or set(owners(before, old[m][1])) & reason
                 or any(is_within(child, reason) for child in old[m][0].values())}
        if not found:
            return reason
        reason |= found
        left -= found


def owners(document, path):
    """Marks of the objects on a path, outermost first."""
    marks = []
    for step in path:
        if isinstance(document, dict) and mark_of(document) is not None:
            marks.append(mark_of(document))
        document = document[step]
    if isinstance(document, dict) and mark_of(document) is not None:
        marks.append(mark_of(document))
    return marks


def place(document, path):
    """A path with the marks of the elements in it, so that it is the same when they move."""
    steps = []
    for step in path:
        document = document[step]
        marked_element = isinstance(step, int) and isinstance(document, dict) and mark_of(document) is not None
        steps.append(("mark", mark_of(document)) if marked_element else step)
    return tuple(steps)


def unlike(before, after):
    wrong = []
    gone = before.marked.keys() - after.marked.keys()
    for where, target in after.single.items():
        if where not in before.single:
            wrong.append(f"{where} refers to something new")
        elif before.single[where] != target:
            wrong.append(f"{where} referred to {before.single[where]}, now to {target}")
    for where, targets in after.lists.items():
        if targets != [t for t in before.lists.get(where, []) if t not in gone or t is None]:
            wrong.append(f"{where} referred to {before.lists.get(where)}, now to {targets}")
    for mark, (value, path) in after.marked.items():
        was, at = before.marked[mark]
        for key, child in was.items():
            if isinstance(child, (dict, list)) and key != "extras":
                continue
            reference = before.places[mark] + (key,)
            if reference in before.single:
                target = before.single[reference]
                lost = key not in value and target not in gone and not (isinstance(target, tuple) and gone & set(target))
                if lost and (WITH.get(key) not in was or WITH[key] in value):
                    wrong.append(f"{path} has lost {key}")
            elif key not in value:
                if WITH.get(key) not in was or WITH[key] in value:
                    wrong.append(f"{path} has lost {key}")
            elif value[key] != child and not is_size(at, key):
                wrong.append(f"{path}/{key} was {child}, is {value[key]}")
        wrong += [f"{path} has a new {key}" for key in value.keys() - was.keys()]
    return wrong


def is_size(path, key):
    """What follows the bytes of a BIN chunk that are cut out."""
    return (path[0] == "buffers" and key == "byteLength") or (path[0] == "bufferViews" and key == "byteOffset")


def dangling(before, after):
    return ["a reference leads nowhere"] if after.dangling > before.dangling else []


def read(path):
    """The document and the BIN chunk, or nothing."""
    data = path.read_bytes()
    try:
        if data[:4] != b"glTF":
            return json.loads(data.decode("utf-8-sig")), None
        length = struct.unpack_from("<I", data, 12)[0]
        document = json.loads(data[20:20 + length])
        rest = data[20 + length:]
        return document, rest[8:8 + struct.unpack_from("<I", rest)[0]] if len(rest) >= 8 else b""
    except (ValueError, struct.error, RecursionError):
        return None


def is_version_2(document):
    asset = document.get("asset")
    return isinstance(asset, dict) and str(asset.get("version", "")).startswith("2")


def write(path, document, binary):
    text = json.dumps(document, separators=(",", ":"), ensure_ascii=False).encode("utf-8", "surrogatepass")
    if binary is None:
        return path.write_bytes(text)
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    if binary:
        padded = binary + b"\0" * (-len(binary) % 4)
        chunks += struct.pack("<I4s", len(padded), b"BIN\0") + padded
    return path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def copy_files(document, source, target):
    """The files that the asset refers to."""
    for array in ("buffers", "images"):
        for element in document.get(array, []):
            uri = urllib.parse.unquote(element.get("uri", "data:"))
            if uri.startswith("data:") or ".." in uri or not (source / uri).is_file():
                continue
            (target / uri).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source / uri, target / uri)


def bytes_of(document, binary, view):
    """The bytes of a buffer view of the BIN chunk."""
    if binary is None or view.get("buffer") != 0 or "uri" in document["buffers"][0]:
        return None
    begin = view.get("byteOffset", 0)
    return binary[begin:begin + view.get("byteLength", 0)]


def check_bytes(before, old_bin, after, new_bin):
    views = {mark_of(v): bytes_of(before, old_bin, v) for v in before.get("bufferViews", [])}
    return [f"bufferViews/{i} holds other bytes" for i, view in enumerate(after.get("bufferViews", []))
            if views.get(mark_of(view)) is not None and bytes_of(after, new_bin, view) != views[mark_of(view)]]


def delete(gltfx, source, folder, pointers):
    target = pathlib.Path(folder) / ("after" + source.suffix)
    command = [gltfx, "edit", str(source), "--isolated", "--format", "json", "--cascade", "-o", str(target), "-j1"]
    for pointer in pointers:
        command += ["--delete", pointer]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode not in (0, 1):
        return None, f"exit code {done.returncode}: {done.stderr}", None
    report = json.loads(done.stdout)["files"][0]
    if report["problem"] != "none":
        return None, "", report["error"]
    return read(target), "", None


# The table above has nothing of these.
OTHERS = ("KHR_audio", "KHR_implicit", "KHR_physics", "KHR_texture_procedurals", "MAXAR_", "NGA_", "OMI_", "VRM")


def has_others(document):
    return any(name.startswith(OTHERS) for name in document.get("extensionsUsed", []))


def walk(gltfx, path, most, groups):
    found = read(path)
    result = {"path": str(path), "objects": 0, "deleted": 0, "refused": {}, "wrong": []}
    if found is None or not isinstance(found[0], dict) or not is_version_2(found[0]) or has_others(found[0]):
        return result
    before, binary = marked(found[0]), found[1]
    walked = Walked(before)
    pointers = deletable(before)
    result["objects"] = len(pointers)
    chance = random.Random(str(path))
    if most and len(pointers) > most:
        pointers = chance.sample(pointers, most)
    runs = [[p] for p in pointers]
    runs += [chance.sample(pointers, min(len(pointers), chance.randint(2, 6))) for _ in range(groups if pointers else 0)]
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / ("before" + path.suffix)
        write(source, before, binary)
        copy_files(before, path.parent, pathlib.Path(folder))
        for run in runs:
            after, failure, refusal = delete(gltfx, source, folder, run)
            if failure:
                result["wrong"].append(f"{run}: {failure}")
            elif refusal is not None:
                kind = "".join("#" if c.isdigit() else c for c in refusal)
                result["refused"].setdefault(kind, []).append(" ".join(run))
            else:
                result["deleted"] += len(run) == 1
                wrong = check_bytes(before, binary, *after)
                now = Walked(after[0])
                if len(run) == 1:
                    wrong += check(walked, now, run[0])
                else:  # all except those with a reason for deletion
                    wrong += dangling(walked, now) + unlike(walked, now)
                result["wrong"] += [f"{run}: {w}" for w in wrong]
    return result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gltfx")
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--most", type=int, default=0, help="objects of an asset; 0: all")
    parser.add_argument("--groups", type=int, default=0, help="runs that delete several objects, of an asset")
    words = parser.parse_args()
    assets = sorted(p for folder in words.folders for p in ([folder] if folder.is_file() else folder.rglob("*"))
                    if p.suffix in (".gltf", ".glb"))
    total = {"objects": 0, "deleted": 0, "refused": {}, "wrong": []}
    one = functools.partial(walk, words.gltfx, most=words.most, groups=words.groups)
    with concurrent.futures.ProcessPoolExecutor(words.jobs) as pool:
        for result in pool.map(one, assets):
            for name in ("objects", "deleted"):
                total[name] += result[name]
            for kind, runs in result["refused"].items():
                total["refused"].setdefault(kind, []).extend(f"{result['path']} {r}" for r in runs)
            total["wrong"] += [f"{result['path']}: {w}" for w in result["wrong"]]
    for line in total["wrong"][:50]:
        print(line)
    print(f"{len(assets)} assets, {total['objects']} objects, {total['deleted']} deleted, "
          f"{len(total['wrong'])} wrong")
    for kind, runs in sorted(total["refused"].items(), key=lambda item: -len(item[1])):
        print(f"{len(runs)} refused: {kind} (such as {runs[0]})")
    return 1 if total["wrong"] or total["deleted"] == 0 else 0


if __name__ == "__main__":
    sys.exit(main())

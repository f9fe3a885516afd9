#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Breaks valid assets in many ways, runs `gltfx fix` over them and compares findings before and after.

    tests/mutants/fix_mutants.py build/dev/bin/gltfx FOLDER... [--count 50000] [--seed N] [--peer NODE_MODULES]

The checks of each mutant: the fixed file has no finding, by gltfx or by npm's gltf-validator, that the broken one has
not; a second run changes nothing; findings that `gltfx validate` marks as fixable are fixed or left with a reason.
Mutants whose text cannot be read are counted, but new findings of theirs are not: what could not be read could not be
found. gltf-validator
leaves out values of a wrong type, renumbers what follows them, and goes on without what is required: what it
finds there is not new. It does not look into an extension that is not declared, and does not know each extension: a
finding of its is not new if it has the same against the valid asset that was broken, or if gltfx has it against the
broken one; that it does not know an extension, or a value that one adds, is none about the asset.

A finding declares a safe fix if it meets the condition that the page of its rule states, so that the fix proposes a
change. Of these, 99 % must be gone from the fixed file. Those that are not are left out because the change would bring
another finding, and `gltfx fix` gives that as the reason. The share of all findings of rules with a safe fix stands
beside it.

The seed of a run is printed; without --seed it is a new one. Mutants with a failure are kept in --keep.
"""
import argparse
import base64
import collections
import copy
import json
import pathlib
import random
import secrets
import shutil
import struct
import subprocess
import sys
import tempfile
import urllib.parse

VALUES = [None, True, False, -1, 0, 1, 2, 3, 1.5, 1e9, -0.5, "x", "", [], {}, [1], [0, 0, 0], 5120, 5123, 5126,
          34962, 34963, "SCALAR", "VEC3", "MAT4", "STEP", "MASK", "image/png", "image/jpeg"]
UNKNOWN_TO_PEER = {"UNSUPPORTED_EXTENSION", "INCOMPLETE_EXTENSION_SUPPORT"}
RENUMBERED = {"TYPE_MISMATCH", "ARRAY_TYPE_MISMATCH"}
UNREADABLE = ("INVALID_JSON", "JSON_", "GLB_", "UTF8_")  # beginnings of codes


# Assets -----------------------------------------------------------------------------------------------------

class Asset:
    """A document, the bytes of its BIN chunk (None: a .gltf) and files that it refers to."""

    def __init__(self, document, binary, files):
        self.document, self.binary, self.files = document, binary, files
        self.text_change = self.glb_change = None
        self.by_peer = {}  # findings of gltf-validator by code, before anything is broken

    @staticmethod
    def read(path):
        data = path.read_bytes()
        binary = None
        if data[:4] == b"glTF":
            length = struct.unpack_from("<I", data, 12)[0]
            rest = data[20 + length:]
            binary = rest[8:8 + struct.unpack_from("<I", rest)[0]] if len(rest) >= 8 else b""
            data = data[20:20 + length]
        document = json.loads(data.decode("utf-8-sig"))
        files = {}
        for array in ("buffers", "images"):
            for element in document.get(array, []):
                uri = element.get("uri", "data:")
                name = urllib.parse.unquote(uri)
                if not uri.startswith("data:") and ".." not in name and (path.parent / name).is_file():
                    files[name] = (path.parent / name).read_bytes()
        return Asset(document, binary, files)

    def write(self, folder, name="a"):
        folder.mkdir(parents=True)
        text = json.dumps(self.document, ensure_ascii=False, indent=1).encode("utf-8", "surrogatepass")
        if self.text_change:
            text = self.text_change(text)
        for file, data in self.files.items():
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            (folder / file).write_bytes(data)
        if self.binary is None:
            path = folder / f"{name}.gltf"
            path.write_bytes(text)
            return path
        text += b" " * (-len(text) % 4)
        chunks = [[b"JSON", text]] + ([[b"BIN\0", self.binary + b"\0" * (-len(self.binary) % 4)]] if self.binary else [])
        path = folder / f"{name}.glb"
        path.write_bytes(self.glb_change(chunks) if self.glb_change else glb(chunks))
        return path


def glb(chunks, total=0, lengths=0):
    data = b"".join(struct.pack("<I4s", len(content) + lengths, kind) + content for kind, content in chunks)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(data) + total) + data


# Mutations: each takes an asset and a random source, and returns whether it changed something
# ----------

def places(value, path=()):
    stack = [(value, path)]
    while stack:
        value, path = stack.pop()
        items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        for key, child in items:
            yield value, key, child
            stack.append((child, path + (key,)))


def objects(holder, array):
    """The objects in an array, also after earlier mutations."""
    found = holder.get(array) if isinstance(holder, dict) else None
    return [one for one in found if isinstance(one, dict)] if isinstance(found, list) else []


def any_of(asset, chance, test):
    found = [place for place in places(asset.document) if test(*place)]
    return chance.choice(found) if found else None


def drop_member(asset, chance):
    place = any_of(asset, chance, lambda holder, key, value: True)
    if place:
        del place[0][place[1]]
    return place


def other_value(asset, chance):
    place = any_of(asset, chance, lambda holder, key, value: True)
    if place:
        place[0][place[1]] = copy.deepcopy(chance.choice(VALUES))
    return place


def other_number(asset, chance):
    place = any_of(asset, chance, lambda h, k, v: isinstance(v, (int, float)) and not isinstance(v, bool))
    if place:
        place[0][place[1]] = place[2] + chance.choice([-1, 1, 2, 0.25, 100])
    return place


def empty_list(asset, chance):
    place = any_of(asset, chance, lambda h, k, v: isinstance(v, dict))
    if place:
        place[2][chance.choice(["children", "nodes", "weights", "targets", "extensions", "animations", "skins"])] = \
            copy.deepcopy(chance.choice([[], {}]))
    return place


def bounds(asset, chance):
    place = any_of(asset, chance, lambda h, k, v: k in ("min", "max") and isinstance(v, list)
                   and v and all(isinstance(number, (int, float)) for number in v))
    if place:
        if chance.random() < 0.4:
            del place[0][place[1]]
        else:
            at = chance.randrange(len(place[2]))
            place[2][at] += chance.choice([-3, -0.001, 0.001, 3])
    return place


def names(asset, chance):
    lists = [asset.document.setdefault(m, []) for m in ("extensionsUsed", "extensionsRequired")
             if isinstance(asset.document.get(m, []), list)]
    if not lists:
        return None
    chosen = chance.choice(lists)
    if chosen and chance.random() < 0.6:
        chosen.pop(chance.randrange(len(chosen)))
    else:
        chosen.append(chance.choice(["KHR_materials_ior", "KHR_texture_transform", "KHR_materials_unlit",
                                     "KHR_lights_punctual"]))
    return True


def transform(asset, chance):
    nodes = objects(asset.document, "nodes")
    if not nodes:
        return None
    node = chance.choice(nodes)
    kind = chance.randrange(4)
    if kind == 0 and isinstance(node.get("rotation"), list):
        node["rotation"] = [c * chance.choice([0.9, 1.01, 3]) if isinstance(c, (int, float)) else c
                            for c in node["rotation"]]
    elif kind == 1 and "matrix" not in node:
        node["matrix"] = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    elif kind == 2:
        node.update({"translation": [0, 0, 0], "scale": [1, 1, 1]})
    else:
        node["rotation"] = [0, 0, chance.choice([2, 0.5, 0]), chance.choice([1, 0])]
    return True


def two_forms(asset, chance):
    """A matrix and its parts, of which none, one or both move the node."""
    nodes = objects(asset.document, "nodes")
    if not nodes:
        return None
    node, x = chance.choice(nodes), chance.choice([0, 0.5])
    node["matrix"] = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1]
    node.update(chance.choice([{"translation": [0, 0, 0]}, {"translation": [0.5, 0, 0]}, {"scale": [1, 1, 1]},
                               {"scale": [2, 1, 1]}, {"rotation": [0, 0, 2, 0]}, {"rotation": [0, 1, 0, 0]}]))
    return True


def roots(asset, chance):
    """Children among the roots of a scene, before or after their ancestors."""
    scenes = [scene for scene in objects(asset.document, "scenes") if isinstance(scene.get("nodes"), list)]
    nodes = objects(asset.document, "nodes")
    if not scenes or len(nodes) < 2:
        return None
    child = chance.randrange(len(nodes))
    parent = (child + 1) % len(nodes)
    nodes[parent].setdefault("children", [])
    if not isinstance(nodes[parent]["children"], list):
        return None
    nodes[parent]["children"].append(child)
    nodes[parent]["translation"] = [chance.choice([0, 0.7]), 0, 0]
    scene = chance.choice(scenes)["nodes"]
    scene.insert(chance.randrange(len(scene) + 1), chance.choice([child, parent]))
    return True


def said_by_others(asset, chance):
    """Extras, and an unknown extension."""
    found = [value for _, _, value in places(asset.document) if isinstance(value, dict)]
    value = chance.choice([9007199254740993, [], {}, {"id": 2.50, "empty": {}, "list": [1, 1]}, -0.0, None])
    holder = chance.choice(found)
    if chance.random() < 0.5:
        holder["extras"] = {"a": value, "extras": {}}
    elif isinstance(holder.setdefault("extensions", {}), dict):
        holder["extensions"]["ACME_parts"] = {"image": 0, "accessor": 0, "nodes": [1, 1], "more": value,
                                              "extensions": {}}
        used = asset.document.setdefault("extensionsUsed", [])
        if isinstance(used, list):
            used.append("ACME_parts")
    return True


def materials(asset, chance):
    found = objects(asset.document, "materials")
    if not found:
        return None
    material = chance.choice(found)
    material.update(chance.choice([{"alphaCutoff": 0.3}, {"emissiveFactor": [1.5, 0, 0]}, {"extensions": {}},
                                   {"alphaMode": "OPAQUE", "alphaCutoff": 0.5}]))
    return True


def images(asset, chance):
    found = objects(asset.document, "images")
    if not found:
        return None
    image = chance.choice(found)
    uri = image.get("uri", "")
    if chance.random() < 0.5 or not isinstance(uri, str) or uri.startswith("data:") or not uri:
        image["mimeType"] = chance.choice(["image/png", "image/jpeg", "image/webp"])
    else:
        image["uri"] = chance.choice(["./" + uri, ".\\" + uri, uri.replace(".", "%2E", 1)])
    return True


def views(asset, chance):
    found = objects(asset.document, "bufferViews")
    if not found:
        return None
    view = chance.choice(found)
    kind = chance.randrange(4)
    if kind == 0:
        view.pop("target", None)
    elif kind == 1:
        view["target"] = chance.choice([34962, 34963])
    elif kind == 2:
        view["byteStride"] = chance.choice([4, 8, 12, 16, 24])
    else:
        view.pop("byteStride", None)
    return True


def buffers(asset, chance):
    found = [b for b in objects(asset.document, "buffers") if isinstance(b.get("byteLength"), int)]
    if not found:
        return None
    chance.choice(found)["byteLength"] += chance.choice([-4, -1, 1, 2, 4, 100])
    return True


def data_of(asset, index):
    """The bytes of a buffer that can be changed, with what puts others in their place."""
    try:
        buffer = asset.document["buffers"][index]
        uri = buffer.get("uri")
        if uri is None:
            return bytearray(asset.binary or b""), lambda data: setattr(asset, "binary", bytes(data))
        if uri.startswith("data:"):
            head, text = uri.split(",", 1)
            return bytearray(base64.b64decode(text)), lambda data: buffer.__setitem__(
                "uri", head + "," + base64.b64encode(data).decode())
        name = urllib.parse.unquote(uri)
        return bytearray(asset.files[name]), lambda data: asset.files.__setitem__(name, bytes(data))
    except (KeyError, IndexError, TypeError, AttributeError, ValueError):
        return None, None


def accessors_of(document, types):
    return [a for a in objects(document, "accessors")
            if a.get("componentType") in types and isinstance(a.get("bufferView"), int)]


def floats(asset, chance):
    document = asset.document
    found = accessors_of(document, (5126,))
    if not found:
        return None
    accessor = chance.choice(found)
    try:
        view = document["bufferViews"][accessor["bufferView"]]
        size = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[accessor["type"]]
        stride = view.get("byteStride", 4 * size)
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        at += chance.randrange(int(accessor["count"])) * stride + 4 * chance.randrange(size)
        data, put = data_of(asset, view["buffer"])
        old = struct.unpack_from("<f", data, at)[0]
        new = chance.choice([float("nan"), float("inf"), -0.0, old * 1.02, old * 3, old + 0.2])
        struct.pack_into("<f", data, at, new)
        put(data)
        return True
    except (AttributeError, KeyError, IndexError, TypeError, ValueError, struct.error, OverflowError):
        return None


def integers(asset, chance):
    document = asset.document
    found = accessors_of(document, (5121, 5123, 5125))
    if not found:
        return None
    accessor = chance.choice(found)
    try:
        view = document["bufferViews"][accessor["bufferView"]]
        form = {5121: "<B", 5123: "<H", 5125: "<I"}[accessor["componentType"]]
        size = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]] * struct.calcsize(form)
        at = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        at += chance.randrange(int(accessor["count"])) * view.get("byteStride", size)
        data, put = data_of(asset, view["buffer"])
        struct.pack_into(form, data, at, chance.choice([0, 1, 2, 3, 200]))
        put(data)
        return True
    except (AttributeError, KeyError, IndexError, TypeError, ValueError, struct.error):
        return None


def text(asset, chance):
    def change(data):
        kind = chance.randrange(6)
        if kind == 0:
            return b"\xef\xbb\xbf" + data
        if kind == 5:
            one, other = chance.choice([(b"9007199254740993", b"9007199254740992"), (b'"\\ud800"', b'"\\ud801"'),
                                        (b"1.0", b"1"), (b'{"a": 1, "a": 2}', b'{"a": 2}'), (b"[1e1]", b"[10]")])
            return data.replace(b"{", b'{"extras": %s, "extras": %s, ' % (one, other), 1)
        if kind == 1:
            ends = [i for i, c in enumerate(data) if c in b"]}" and i > 1 and data[i - 1:i] == b"\n" or c in b"]}"]
            at = chance.choice(ends)
            return data[:at] + b"," + data[at:]
        if kind == 2:
            return data.replace(b'"asset"', b'"asset": {"version": "2.0"}, "asset"', 1)
        if kind == 3:
            name, value = chance.choice(list(asset.document.items()) or [("asset", {"version": "2.0"})])
            return data.replace(b"{", b"{%s: %s, " % (json.dumps(name).encode(), json.dumps(value).encode()), 1)
        at = data.find(b'": "')
        return data if at < 0 else data[:at + 4] + b"\t" + data[at + 4:]
    asset.text_change = change
    return True


def container(asset, chance):
    if asset.binary is None:
        return None
    kind = chance.randrange(5)
    if kind == 0:
        asset.glb_change = lambda chunks: glb(chunks, total=chance.choice([-4, 4, 1, 1000]))
    elif kind == 1:
        asset.glb_change = lambda chunks: glb(chunks) + bytes(chance.choice([1, 4, 7]))
    elif kind == 2:
        asset.glb_change = lambda chunks: glb([[k, c + (b" " if k == b"JSON" else b"\0")] for k, c in chunks])
    elif kind == 3:
        asset.glb_change = lambda chunks: glb([[k, c.rstrip(b" ") + b"\0" * (-len(c.rstrip(b" ")) % 4)
                                               if k == b"JSON" else c] for k, c in chunks])
    else:
        asset.glb_change = lambda chunks: glb(chunks + [[b"BIN\0", b""]])
    return True


def animations(asset, chance):
    found = [s for a in objects(asset.document, "animations") for s in objects(a, "samplers")]
    if not found:
        return None
    chance.choice(found).update(chance.choice([{"interpolation": "LINEAR"}, {"interpolation": "linear"}]))
    return True


def misspell(asset, chance):
    place = any_of(asset, chance, lambda h, k, v: isinstance(k, str) and len(k) > 4)
    if place:
        at = chance.randrange(1, len(place[1]))
        place[0][place[1][:at] + place[1][at + 1:]] = place[0].pop(place[1])
    return place


MUTATIONS = [two_forms, roots, said_by_others, drop_member, other_value, other_number, empty_list, bounds, bounds,
             names, names, transform, transform,
             materials, images, images, views, views, buffers, floats, floats, floats, integers, text, container,
             container, animations, misspell]


def mutant(seeds, chance):
    asset = copy.deepcopy(chance.choice(seeds))
    done = []
    for _ in range(40):
        change = chance.choice(MUTATIONS)
        if change(asset, chance):
            done.append(change.__name__)
        if len(done) >= chance.choice([1, 1, 1, 2, 3]):
            break
    return asset, done


# Findings ----------------------------------------------------------------------------------------------------

def run(words, **more):
    done = subprocess.run(words, capture_output=True, text=True, **more)
    if done.returncode not in (0, 1, 3):
        raise RuntimeError(f"{words[:3]} exits with {done.returncode}: {done.stderr[-2000:]}")
    return done.stdout


class Findings(collections.Counter):
    """What findings count by code. A finding may count several elements: `entries` has the number of findings by
    code, `marked` that of those that gltfx fix is said to fix."""

    def __init__(self, *words):
        super().__init__(*words)
        self.entries, self.marked = collections.Counter(), 0


def findings(gltfx, folder, jobs):
    """By folder of the asset."""
    out = run([gltfx, "validate", str(folder), "--isolated", "--profile", "strict", "--format", "json",
               "--max-issues", "0", "--fail-on", "never", "-j", jobs])
    report = json.loads(out)
    result = {}
    for file in report["files"]:
        codes = Findings()
        codes.marked = file["fixable"]
        codes.entries = collections.Counter(one["code"] for one in file["findings"])
        for one in file["findings"]:
            codes[one["code"]] += one.get("count", 1)
        result[pathlib.Path(file["path"]).parent.name] = codes
    return result


class Peer:
    def __init__(self, modules):
        script = pathlib.Path(__file__).with_name("khronos.mjs")
        self.process = subprocess.Popen(["node", str(script), modules], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def codes(self, path):
        self.process.stdin.write(f"{path}\n")
        self.process.stdin.flush()
        codes = json.loads(self.process.stdout.readline())
        if codes.keys() & UNKNOWN_TO_PEER:
            codes.pop("VALUE_NOT_IN_LIST", None)
        return {code: count for code, count in codes.items() if code not in UNKNOWN_TO_PEER}


def most(*counts):
    union = collections.Counter()
    for one in counts:
        union |= collections.Counter({code: count for code, count in one.items() if isinstance(count, int)})
    return union


def more(before, after):
    return {code: (before.get(code, 0), count) for code, count in after.items()
            if isinstance(count, int) and count > before.get(code, 0)}


# The run -----------------------------------------------------------------------------------------------------

class Totals:
    def __init__(self):
        self.mutants = self.changed = self.unreadable = self.asked = 0
        self.had, self.gone, self.left_out = (collections.Counter() for _ in range(3))
        self.reasons = collections.Counter()
        self.marked = 0
        self.hidden = 0  # mutants with further findings of gltf-validator, which are not new
        self.failures = []


def compare(mutants, gltfx, peer, safe, work, words, totals):
    before = findings(gltfx, work / "in", words.jobs)
    strict = [gltfx, "fix", "--isolated", "--profile", "strict", "--format", "json", "-j", words.jobs]
    fixed = json.loads(run([*strict, str(work / "in"), "-o", f"{work / 'out'}/"]))
    changed = {pathlib.Path(file["path"]).parent.name: file for file in fixed["files"]}
    after = findings(gltfx, work / "out", words.jobs)
    again = json.loads(run([*strict, str(work / "out")]))
    twice = {pathlib.Path(file["path"]).parent.name for file in again["files"] if file["changes"]}
    for name, (path, done, by_peer) in mutants.items():
        totals.mutants += 1
        report = changed.get(name, {"problem": "missing"})
        if report["problem"] != "none":
            totals.unreadable += 1
            continue
        totals.changed += report["changes"]
        wrong = []
        old, new = before.get(name, Findings()), after.get(name, Findings())
        readable = not any(code.startswith(UNREADABLE) for code in old)
        if name in twice:
            wrong.append("a second run changes it")
        if readable and more(old, new):
            wrong.append(f"new by gltfx: {more(old, new)}")
        gone = collections.Counter({code: old.entries[code] - new.entries[code] for code in old.keys() & safe})
        gone = +gone
        totals.had.update({code: count for code, count in old.entries.items() if code in safe})
        totals.gone.update(gone)
        for action in report["actions"]:
            if "why" in action and action["code"] in safe:
                count = min(action["count"], new.entries[action["code"]])  # one finding may have several places
                totals.left_out[action["code"]] += count
                totals.reasons[f"{action['code']}: {action['why']}"] += count
        totals.marked += old.marked
        dropped = sum(max(0, old[code] - new[code]) for code in old.keys() & safe)
        left = sum(action["count"] for action in report["actions"] if "why" in action and action["code"] in safe)
        if dropped + left < old.marked:
            wrong.append(f"{old.marked} marked, {dropped} gone, {left} left with a reason: {more(new, old)}")
        if peer and report["changes"]:
            totals.asked += 1
            theirs, now = peer.codes(path), peer.codes(str(path).replace("/in/", "/out/", 1))
            known = most(theirs, by_peer, old)
            if readable and "" not in theirs and more(theirs, now):
                if more(known, now) and not old.keys() & RENUMBERED:
                    wrong.append(f"new by gltf-validator: {more(known, now)}")
                else:
                    totals.hidden += 1
        if wrong:
            fixes = sorted(a["code"] for a in report["actions"] if a["done"])
            totals.failures.append((name, done, fixes, wrong))
            if words.keep and len(totals.failures) <= 200:
                kept = pathlib.Path(words.keep) / name
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(path.parent, kept)


def valid_assets(gltfx, folders, largest):
    """Those without errors, with their files no larger than that."""
    report = json.loads(run([gltfx, "validate", *map(str, folders), "--isolated", "--fail-on", "never", "--format",
                             "json"]))
    assets = []
    for path in sorted(pathlib.Path(file["path"]) for file in report["files"] if file["counts"]["errors"] == 0):
        try:
            asset = Asset.read(path)
        except (ValueError, struct.error, OSError, RecursionError):
            continue
        if path.stat().st_size + sum(map(len, asset.files.values())) <= largest:
            assets.append(asset)
    return assets


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gltfx")
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=50_000)
    parser.add_argument("--batch", type=int, default=500)
    parser.add_argument("--seed", type=int, default=secrets.randbits(32))
    parser.add_argument("--peer", default="", help="node_modules with gltf-validator")
    parser.add_argument("--jobs", default="2")
    parser.add_argument("--largest", type=int, default=200_000, help="bytes of an asset and its files")
    parser.add_argument("--keep", default="")
    words = parser.parse_args()
    print(f"seed {words.seed}", flush=True)
    chance = random.Random(words.seed)
    peer = Peer(words.peer) if words.peer else None
    seeds = valid_assets(words.gltfx, words.folders, words.largest)
    for asset in seeds if peer else []:
        with tempfile.TemporaryDirectory(prefix="gltfx_valid_") as folder:
            asset.by_peer = peer.codes(asset.write(pathlib.Path(folder) / "asset"))
    rules = json.loads(run([words.gltfx, "rules", "--format", "json"]))["rules"]
    safe = {rule["code"] for rule in rules if rule["fix"] == "safe"}
    totals = Totals()
    print(f"{len(seeds)} assets, {len(safe)} rules with a safe fix", flush=True)
    for first in range(0, words.count, words.batch):
        with tempfile.TemporaryDirectory(prefix="gltfx_mutants_") as folder:
            work = pathlib.Path(folder)
            mutants = {}
            for number in range(first, min(first + words.batch, words.count)):
                asset, done = mutant(seeds, chance)
                name = f"m{number:06}"
                mutants[name] = (asset.write(work / "in" / name), done, asset.by_peer)
            compare(mutants, words.gltfx, peer, safe, work, words, totals)
    return tell(totals, safe)


def tell(totals, safe):
    for name, done, fixes, wrong in totals.failures:
        print(f"{name} ({', '.join(done)}; fixed {', '.join(fixes)}): {'; '.join(wrong)}")
    codes = sorted(totals.had.keys() | totals.left_out.keys())
    for code in codes:
        print(f"{code}: {totals.had[code]} findings, {totals.gone[code] + totals.left_out[code]} declare a safe fix, "
              f"{totals.gone[code]} gone")
    for reason, count in totals.reasons.most_common(30):
        print(f"left out {count} times: {reason}")
    print(f"never met: {', '.join(sorted(safe - set(codes)))}")
    had, gone, left_out = totals.had.total(), totals.gone.total(), totals.left_out.total()
    share = gone / max(1, gone + left_out)
    print(f"{totals.mutants} mutants, gltf-validator asked about {totals.asked} ({totals.hidden} times it "
          f"finds what was hidden from it), {totals.changed} changed, "
          f"{totals.unreadable} not fixed, "
          f"{len(totals.failures)} with a failure; {totals.marked} findings marked; {gone + left_out} declare a safe "
          f"fix, {share:.2%} of them gone; of all {had} findings of rules with a safe fix "
          f"{gone / max(1, had):.2%} are gone")
    return 1 if totals.failures or share < 0.99 else 0


if __name__ == "__main__":
    sys.exit(main())

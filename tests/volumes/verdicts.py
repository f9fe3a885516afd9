#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Compares what `gltfx validate` says of bounding volumes with samples of its own.

    tests/volumes/verdicts.py build/dev/bin/gltfx [FILE|FOLDER...]   [--seeds N]

Nodes of assets get volumes that enclose all poses with 1 % to spare, for which there must be no finding, and
volumes that miss 1 %: then there must be one, with the distance that the samples have, within 1 %. After
`gltfx fix` no volume may miss a sample. Assets are made by moving_scenes.py, and copied from the given files if they
have animations or skins; those that are made are also external assets of others. Prints what was wrong, and how much was looked at; the exit code says whether all is
well.
"""
import argparse
import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

import posed
import moving_scenes as scenes
from posed import assets

CODES = ("BOUNDING_VOLUME_TOO_SMALL", "BOUNDING_VOLUME_MISSES_POSES")
SPARE = 0.01
AGREEMENT = 0.01
ROUNDING = 2e-5  # of the size


def turned(rotation):
    return assets.local_matrix({"rotation": rotation})[:3, :3]


class Volume:
    def __init__(self, kind, half, center, rotation):
        self.kind, self.half, self.center, self.rotation = kind, np.array(half), np.array(center), rotation

    def size(self):
        return 2 * (np.linalg.norm(self.half) if self.kind == "box" else self.half[0])

    def misses(self, points):
        """The greatest distance outside."""
        at = np.abs((points - self.center) @ turned(self.rotation))
        if self.kind == "box":
            return float(np.linalg.norm(np.maximum(at - self.half, 0), axis=1).max())
        return float(np.linalg.norm(at, axis=1).max() - self.half[0])

    def shape(self):
        if self.kind == "box":
            return {"type": "box", "box": {"size": (2 * self.half).tolist()}}
        return {"type": "sphere", "sphere": {"radius": float(self.half[0])}}

    def placed(self, index):
        return {"shape": index, "translation": self.center.tolist(), "rotation": list(map(float, self.rotation))}


def around(kind, rotation, sampled):
    """The smallest box in that rotation, or a sphere around its middle."""
    axes = turned(rotation)
    inside = [points @ axes for points in sampled]
    low = np.min([each.min(0) for each in inside], 0)
    high = np.max([each.max(0) for each in inside], 0)
    center = axes @ ((low + high) / 2)
    half = np.maximum((high - low) / 2, 1e-3 * (high - low).max())
    if kind == "sphere":
        half = np.full(3, max(np.linalg.norm(points - center, axis=1).max() for points in sampled))
    return Volume(kind, half, center, rotation)


def enclosing(volume):
    return Volume(volume.kind, volume.half * (1 + SPARE), volume.center, volume.rotation)


def missing(volume, random):
    """Smaller by a hundredth of the size, on one side of a box."""
    cut = SPARE * volume.size()
    if volume.kind == "sphere":
        return Volume("sphere", volume.half - cut, volume.center, volume.rotation)
    axis = int(np.argmax(volume.half)) if random.random() < 0.5 else int(random.integers(3))
    if volume.half[axis] < 2 * cut:
        axis = int(np.argmax(volume.half))
    half, side = volume.half.copy(), np.zeros(3)
    half[axis] -= cut / 2
    side[axis] = cut / 2 * (1 if random.random() < 0.5 else -1)
    return Volume("box", half, volume.center + turned(volume.rotation) @ side, volume.rotation)


class Run:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.wrong, self.assets, self.volumes, self.moments = [], 0, 0, 0

    def findings(self, paths):
        """Of each file: its errors, and how far the geometry is outside of its volume."""
        done = subprocess.run([self.program, "validate", "--isolated", "--format", "json"]
                              + [str(path) for path in paths], capture_output=True, text=True)
        reports = {pathlib.Path(each["path"]).name: each for each in json.loads(done.stdout)["files"]}
        for path in paths:
            found = reports[path.name]["findings"]
            amounts = [float(re.search(r"which lies ([0-9.e+-]+)", each["message"])[1])
                       for each in found if each["code"] in CODES]
            yield [each for each in found if each["severity"] == "error"], amounts[0] if amounts else 0.0

    def write(self, document, volumes, name):
        """A file for each node: findings at several nodes would become one."""
        paths = []
        for node, volume in volumes.items():
            own = json.loads(json.dumps(document))
            own["shapes"] = [volume.shape()]
            own["nodes"][node]["boundingVolume"] = volume.placed(0)
            paths.append(self.folder / ("%s-%d.gltf" % (name, node)))
            paths[-1].write_text(json.dumps(own))
        return paths

    def expect(self, name, paths, asset, volumes, samples, moments):
        for (node, volume), (errors, given) in zip(volumes.items(), self.findings(paths)):
            most = asset.greatest(node, volume.misses, moments, samples[node])
            self.volumes += 1
            if errors:
                self.wrong.append("%s, node %d: %s" % (name, node, errors[0]["message"]))
            elif most <= ROUNDING * volume.size():
                if given:
                    self.wrong.append("%s, node %d: %g is outside, not 0" % (name, node, given))
            elif abs(given - most) > AGREEMENT * most:
                self.wrong.append("%s, node %d (%s): %g is outside, not %g" % (name, node, volume.kind, given, most))

    def expect_fixed(self, name, paths, asset, volumes, samples, moments):
        subprocess.run([self.program, "fix", "--isolated", "--in-place", "--unsafe", "--only", ",".join(CODES)]
                       + [str(path) for path in paths], capture_output=True, text=True)
        for (node, old), path in zip(volumes.items(), paths):
            document = json.loads(path.read_text())
            placed = document["nodes"][node]["boundingVolume"]
            shape = document["shapes"][placed["shape"]]
            half = (np.array(shape["box"]["size"]) / 2 if old.kind == "box"
                    else np.full(3, shape["sphere"]["radius"]))
            volume = Volume(old.kind, half, placed.get("translation", [0, 0, 0]), old.rotation)
            most = asset.greatest(node, volume.misses, moments, samples[node])
            if most > ROUNDING * volume.size():
                self.wrong.append("%s, node %d: after the fix %g is outside" % (name, node, most))
            if volume.size() > 1.02 * old.size():
                self.wrong.append("%s, node %d: the fix makes %g of %g" % (name, node, volume.size(), old.size()))

    def add(self, name, document, nodes, seed):
        path = self.folder / "plain.gltf"
        path.write_text(json.dumps(document))
        return self.add_posed(name, document, nodes, seed, posed.Posed(assets.Asset(path)))

    def add_external(self, name, document, seed):
        """The asset below two nodes of another one, at which volumes are."""
        path = self.folder / "child.gltf"
        path.write_text(json.dumps(document))
        builder = scenes.Builder(seed)
        upper, lower = builder.place(), builder.place()
        data = base64.b64encode(json.dumps(document).encode()).decode()
        parent = {"asset": {"version": "2.1"}, "scene": 0, "scenes": [{"nodes": [0]}],
                  "nodes": [{**upper, "children": [1]}, {**lower, "externalAsset": 0}],
                  "externalAssets": [{"file": 0}],
                  "files": [{"uri": "data:model/gltf+json;base64," + data, "mimeType": "model/gltf+json"}]}
        asset = posed.External(assets.Asset(path), {0: assets.local_matrix(lower), 1: np.eye(4)})
        return self.add_posed(name + " below another asset", parent, [0, 1], seed, asset)

    def add_posed(self, name, document, nodes, seed, asset):
        random = np.random.default_rng(seed)
        path = self.folder / "plain.gltf"
        path.write_text(json.dumps(document))
        if next(self.findings([path]))[0]:
            return False
        moments = asset.moments()
        samples = {node: [asset.all_points(node, *moment) for moment in moments] for node in nodes}
        samples = {node: each for node, each in samples.items() if len(each[0])}
        volumes = {}
        for node, each in samples.items():
            rotation = random.normal(size=4) if random.random() < 0.5 else np.array([0.0, 0, 0, 1])
            volumes[node] = around("box" if random.random() < 0.6 else "sphere",
                                   rotation / np.linalg.norm(rotation), each)
        self.assets += 1
        self.moments += len(moments)
        large = {node: enclosing(volume) for node, volume in volumes.items()}
        small = {node: missing(volume, random) for node, volume in volumes.items()}
        self.expect(name + " enclosed", self.write(document, large, "large"), asset, large, samples, moments)
        paths = self.write(document, small, "small")
        self.expect(name + " missed", paths, asset, small, samples, moments)
        self.expect_fixed(name, paths, asset, volumes, samples, moments)
        return True


def embedded(path):
    """The asset as glTF 2.1 without other files and images; nothing: it moves nothing."""
    asset = assets.Asset(path)
    document = asset.json
    if not document.get("animations") and not document.get("skins"):
        return None
    for index, buffer in enumerate(document.get("buffers", [])):
        data = asset.resource(buffer["uri"]) if "uri" in buffer else asset.bin
        buffer["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    for member in ("images", "textures", "materials", "samplers"):
        document.pop(member, None)
    for mesh in document.get("meshes", []):
        for primitive in mesh["primitives"]:
            primitive.pop("material", None)
    document["asset"]["version"] = "2.1"
    document["asset"].pop("minVersion", None)
    return document


def copied(run, path):
    try:
        document = embedded(path)
        if document is None:
            return False
        drawn = [i for i, node in enumerate(document.get("nodes", [])) if "mesh" in node]
        roots = document["scenes"][document.get("scene", 0)]["nodes"]
        return run.add(str(path), document, sorted(set(roots[:3] + drawn[:3])), 1)
    except (assets.Unreadable, KeyError, IndexError, TypeError, ValueError, OSError):
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("paths", nargs="*", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--least", type=int, default=0, help="of the given files that must be usable")
    arguments = parser.parse_args()
    used = 0
    with tempfile.TemporaryDirectory() as folder:
        run = Run(arguments.program, pathlib.Path(folder))
        for name in scenes.KINDS:
            for seed in range(arguments.seeds):
                if not run.add("%s %d" % (name, seed), *scenes.make(name, seed), seed):
                    run.wrong.append("%s %d has errors" % (name, seed))
            if not run.add_external(name, scenes.make(name, 0)[0], 0):
                run.wrong.append("%s as an external asset has errors" % name)
        for path in arguments.paths:
            files = sorted(path.rglob("*.gl[tb]*")) if path.is_dir() else [path]
            used += sum(copied(run, each) for each in files if each.suffix in (".gltf", ".glb"))
    if used < arguments.least:
        run.wrong.append("only %d of the given files could be used" % used)
    for line in run.wrong:
        print(line)
    print("%d assets (%d of the given files), %d volumes, %d moments, %d wrong"
          % (run.assets, used, run.volumes, run.moments, len(run.wrong)))
    return 1 if run.wrong else 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: Apache-2.0
"""Measures what quantization lost, from the text of the specification and not from gltfx."""
import numpy as np

from asset import Unreadable


class Broken(Exception):
    """The result is wrong."""


def need(condition, why):
    if not condition:
        raise Broken(why)


def diagonal(points):
    return float(np.linalg.norm(points.max(0) - points.min(0))) if len(points) else 0.0


def angle(a, b):
    """Greatest, in degrees, of directions that are not zero."""
    used = np.linalg.norm(a, axis=1) > 0
    if not used.any():
        return 0.0
    a, b = a[used], b[used]
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), (a * b).sum(1))).max())


class Shape:
    """The corners of one primitive, before and after."""

    def __init__(self, old, new, before, after):
        self.pairs = {}
        count = old.json["accessors"][before["attributes"]["POSITION"]]["count"]
        used = old.corners(before, count)
        need(set(before["attributes"]) == set(after["attributes"]), "an attribute is gone")
        need(np.array_equal(used, new.corners(after, count)), "corners changed")
        for name, index in before["attributes"].items():
            self.pairs[name] = (old.numbers(index)[used], new.numbers(after["attributes"][name])[used])
        targets = list(zip(before.get("targets", []), after.get("targets", [])))
        self.positions = [self.pairs["POSITION"]]
        moved = tuple(np.array(each) for each in self.pairs["POSITION"])
        for here, there in targets:
            if "POSITION" in here:
                moved[0][:] += old.numbers(here["POSITION"])[used]
                moved[1][:] += new.numbers(there["POSITION"])[used]
        if targets:
            self.positions.append(moved)

    def sets(self, kind):
        return [name for name in sorted(self.pairs) if name.startswith(kind + "_")]

    def skinned(self, side, points, matrices):
        weights = np.concatenate([self.pairs[name][side] for name in self.sets("WEIGHTS")], 1)
        joints = np.concatenate([self.pairs[name][side] for name in self.sets("JOINTS")], 1).astype(int)
        weights = weights / np.maximum(weights.sum(1, keepdims=True), 1e-30)
        points = np.c_[points, np.ones(len(points))]
        return np.einsum("nk,nkab,nb->na", weights, matrices[joints], points)[:, :3]


def mesh_node(asset, old_count, index):
    """The node that draws the mesh of a node: itself, or a new child."""
    node = asset.list("nodes")[index]
    if "mesh" in node:
        return index
    need(node.get("children") and node["children"][-1] >= old_count, "node %d lost its mesh" % index)
    child = node["children"][-1]
    need("name" not in asset.list("nodes")[child], "a new node has a name")
    return child


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def shown_positions(old, new):
    """(in the scene, mesh, corners before, corners after) in the space of the scene, for all places."""
    before, seen = old.world()
    after, _ = new.world()
    count = len(old.list("nodes"))
    shapes = {}
    for i, node in enumerate(old.list("nodes")):
        if "mesh" not in node:
            continue
        k = mesh_node(new, count, i)
        drawn = new.list("nodes")[k]
        for pair in zip(old.list("meshes")[node["mesh"]]["primitives"],
                        new.list("meshes")[drawn["mesh"]]["primitives"]):
            if "POSITION" not in pair[0]["attributes"]:
                continue
            key = id(pair[0]), id(pair[1])
            if key not in shapes:
                shapes[key] = Shape(old, new, *pair)
            shape = shapes[key]
            for here, there in shape.positions:
                if "skin" in node:
                    need(drawn.get("skin") == node["skin"], "another skin")
                    if not shape.sets("JOINTS"):
                        continue
                    yield (i in seen, node["mesh"], shape.skinned(0, here, old.joints(node["skin"], before)),
                           shape.skinned(1, there, new.joints(drawn["skin"], after)))
                    continue
                for a, b in zip(old.instances(node), new.instances(drawn)):
                    yield i in seen, node["mesh"], moved(before[i] @ a, here), moved(after[k] @ b, there)


def scene_diagonal(old):
    """Of the default scene at rest, with weights of morph targets."""
    points = []
    world, seen = old.world()
    for i in sorted(seen):
        node = old.list("nodes")[i]
        if "mesh" not in node:
            continue
        mesh = old.list("meshes")[node["mesh"]]
        for primitive in mesh["primitives"]:
            if "POSITION" not in primitive["attributes"]:
                continue
            shape = Shape(old, old, primitive, primitive)
            at = np.array(shape.pairs["POSITION"][0])
            used = old.corners(primitive, old.json["accessors"][primitive["attributes"]["POSITION"]]["count"])
            for weight, target in zip(node.get("weights", mesh.get("weights", [])), primitive.get("targets", [])):
                if weight and "POSITION" in target:
                    at += weight * old.numbers(target["POSITION"])[used]
            if "skin" in node and shape.sets("JOINTS"):
                points.append(shape.skinned(0, at, old.joints(node["skin"], world)))
            else:
                points += [moved(world[i] @ each, at) for each in old.instances(node)]
    return diagonal(np.concatenate(points)) if points else 0.0


def attribute_losses(old, new, losses):
    side = None
    for a, b in zip(old.list("meshes"), new.list("meshes")):
        for pair in zip(a["primitives"], b["primitives"]):
            if "POSITION" not in pair[0]["attributes"]:
                continue
            shape = Shape(old, new, *pair)
            for name, (here, there) in shape.pairs.items():
                kind = name.rsplit("_", 1)[0] if not name.startswith("_") else name
                if kind in ("NORMAL", "TANGENT"):
                    losses["normals"] = max(losses["normals"], angle(here[:, :3], there[:, :3]))
                    need(kind == "NORMAL" or np.array_equal(here[:, 3], there[:, 3]), "w of a tangent changed")
                elif kind in ("TEXCOORD", "COLOR", "WEIGHTS"):
                    away = float(np.abs(here - there).max(initial=0))
                    if kind == "TEXCOORD" and away > 0:
                        side = side or old.longest_side()
                        away *= side
                    key = {"TEXCOORD": "texture coordinates", "COLOR": "colors", "WEIGHTS": "weights"}[kind]
                    losses[key] = max(losses[key], away * (100 if kind == "WEIGHTS" else 1))
                elif kind != "POSITION":
                    need(np.array_equal(here, there), "%s changed" % name)
            check_sums(new, pair[1])


def check_sums(new, primitive):
    sets = [new.integers(index) for name, index in primitive["attributes"].items() if name.startswith("WEIGHTS_")]
    if sets and all(each.dtype == np.uint16 for each in sets):
        sums = sum(each.astype(int).sum(1) for each in sets)
        need(np.isin(sums, (0, 65535)).all(), "weights do not add up")


def measure(old, new):
    """The greatest loss of each quantity, in the units of the report of gltfx."""
    losses = {"positions": 0.0, "normals": 0.0, "texture coordinates": 0.0, "colors": 0.0, "weights": 0.0}
    scene = scene_diagonal(old)
    for in_scene, mesh, here, there in shown_positions(old, new):
        if not len(here):
            continue
        away = float(np.linalg.norm(here - there, axis=1).max())
        size = scene if in_scene else diagonal(here)
        if size > 0 and away > 0:
            losses["positions"] = max(losses["positions"], 100 * away / size)
    attribute_losses(old, new, losses)
    return losses

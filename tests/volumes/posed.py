# SPDX-License-Identifier: Apache-2.0
"""Poses assets with NumPy, independent of gltfx: animations, morph targets and skins."""
import pathlib
import sys

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "quantize"))
import asset as assets  # noqa: E402

PARTS = 48  # moments between two keyframes
CLOSER = 60  # moments around the best one


def slerp(a, b, t):
    product = a @ b
    if product < 0:
        b, product = -b, -product
    if product > 0.9999999:
        mixed = a + (b - a) * t
    else:
        angle = np.arccos(np.clip(product, -1, 1))
        mixed = (np.sin((1 - t) * angle) * a + np.sin(t * angle) * b) / np.sin(angle)
    return mixed / np.linalg.norm(mixed)


class Channel:
    def __init__(self, asset, animation, channel):
        sampler = animation["samplers"][channel["sampler"]]
        self.node, self.path = channel["target"].get("node"), channel["target"]["path"]
        self.kind = sampler.get("interpolation", "LINEAR")
        self.times = asset.numbers(sampler["input"])[:, 0]
        values = asset.numbers(sampler["output"])
        parts = 3 if self.kind == "CUBICSPLINE" else 1
        self.values = values.reshape(len(self.times), parts, -1)

    def at(self, time):
        key = int(np.clip(np.searchsorted(self.times, time, "right") - 1, 0, len(self.times) - 1))
        middle = self.values.shape[1] // 2
        first = self.values[key, middle]
        if key + 1 == len(self.times) or time <= self.times[key] or self.kind == "STEP":
            value = first
        else:
            span = self.times[key + 1] - self.times[key]
            t = (time - self.times[key]) / span
            last = self.values[key + 1, middle]
            if self.kind == "CUBICSPLINE":
                out, into = self.values[key, 2], self.values[key + 1, 0]
                value = ((2 * t**3 - 3 * t**2 + 1) * first + span * (t**3 - 2 * t**2 + t) * out
                         + (3 * t**2 - 2 * t**3) * last + span * (t**3 - t**2) * into)
            elif self.path == "rotation":
                value = slerp(first, last, t)
            else:
                value = first * (1 - t) + last * t
        return value / np.linalg.norm(value) if self.path == "rotation" else value


class Posed:
    """The points that nodes draw, at any moment."""

    def __init__(self, asset):
        self.asset = asset
        self.nodes = asset.list("nodes")
        self.parents = {child: i for i, node in enumerate(self.nodes) for child in node.get("children", [])}
        self.clips = [[Channel(asset, each, channel) for channel in each["channels"]
                       if channel["target"].get("node") is not None]
                      for each in asset.list("animations")]
        self.meshes = {}

    def below(self, node):
        found, left = [], [node]
        while left:
            found.append(left.pop())
            left += self.nodes[found[-1]].get("children", [])
        return found

    def is_affine(self, node):
        """Whether the node has a matrix of its own, which animations do not change."""
        return "matrix" in self.nodes[node]

    def pose(self, clip, time):
        """The nodes with what the clip changes, and their transforms."""
        nodes = [dict(node) for node in self.nodes]
        for channel in self.clips[clip] if clip is not None else []:
            nodes[channel.node][channel.path] = channel.at(time)
        locals_ = [assets.local_matrix(node) for node in nodes]
        world = {}

        def world_of(node):
            way = []
            while node is not None and node not in world:
                way.append(node)
                node = self.parents.get(node)
            matrix = np.eye(4) if node is None else world[node]
            for each in reversed(way):
                matrix = matrix @ locals_[each]
                world[each] = matrix
            return matrix

        for i in range(len(nodes)):
            world_of(i)
        return nodes, world

    def mesh(self, index):
        if index not in self.meshes:
            parts = []
            for primitive in self.asset.json["meshes"][index]["primitives"]:
                attributes = primitive["attributes"]
                positions = self.asset.numbers(attributes["POSITION"])
                used = self.asset.corners(primitive, len(positions))
                targets = [self.asset.numbers(each["POSITION"])[used] if "POSITION" in each
                           else np.zeros((len(used), 3)) for each in primitive.get("targets", [])]
                influences = []
                while "JOINTS_%d" % len(influences) in attributes:
                    n = len(influences)
                    influences.append((self.asset.integers(attributes["JOINTS_%d" % n])[used].astype(int),
                                       self.asset.numbers(attributes["WEIGHTS_%d" % n])[used]))
                parts.append((positions[used], targets, influences))
            self.meshes[index] = parts
        return self.meshes[index]

    def points(self, node, nodes, world, upper):
        """What a node draws, in the space of another one."""
        described = nodes[node]
        if "mesh" not in described:
            return np.zeros((0, 3))
        to_upper = np.eye(4) if upper is None else np.linalg.inv(world[upper])
        mesh = self.asset.json["meshes"][described["mesh"]]
        weights = described.get("weights", mesh.get("weights"))
        skinned = "skin" in described
        joints = self.asset.joints(described["skin"], world) if skinned else None
        found = []
        for positions, targets, influences in self.mesh(described["mesh"]):
            at = positions.copy()
            for k, target in enumerate(targets):
                at += target * (weights[k] if weights is not None and k < len(weights) else 0)
            at = np.hstack([at, np.ones((len(at), 1))])
            if skinned:
                matrices = np.zeros((len(at), 4, 4))
                total = sum(w.sum(1) for _, w in influences)
                for which, w in influences:
                    for k in range(4):
                        matrices += joints[which[:, k]] * (w[:, k] / total)[:, None, None]
                found.append((np.einsum("nij,nj->ni", matrices, at) @ to_upper.T)[:, :3])
            else:
                for copy in self.asset.instances(described):
                    found.append((at @ (to_upper @ world[node] @ copy).T)[:, :3])
        return np.vstack(found)

    def all_points(self, upper, clip=None, time=0.0):
        nodes, world = self.pose(clip, time)
        return np.vstack([self.points(i, nodes, world, upper) for i in self.below(upper)])

    def times(self, clip):
        keys = sorted({float(t) for channel in self.clips[clip] for t in channel.times})
        times = list(keys[:1])
        for a, b in zip(keys, keys[1:]):
            times += [a + (b - a) * i / PARTS for i in range(1, PARTS + 1)]
        return times

    def moments(self):
        """At rest, and all clips."""
        return [(None, 0.0)] + [(clip, time) for clip in range(len(self.clips)) for time in self.times(clip)]

    def greatest(self, upper, measure, moments, sampled):
        """The greatest value of a measure of points: of the samples, then of moments around the best."""
        values = [measure(points) for points in sampled]
        best = int(np.argmax(values))
        clip, time = moments[best]
        most = values[best]
        if clip is None:
            return most
        near = [moments[i][1] for i in (best - 1, best + 1) if 0 <= i < len(moments) and moments[i][0] == clip]
        low, high = min(near + [time]), max(near + [time])
        for _ in range(3):
            tried = np.linspace(low, high, CLOSER + 1)
            found = [measure(self.all_points(upper, clip, t)) for t in tried]
            k = int(np.argmax(found))
            most = max(most, found[k])
            low, high = tried[max(k - 1, 0)], tried[min(k + 1, CLOSER)]
        return most


class External(Posed):
    """An external asset below nodes of another one, whose places it has: matrices from its scene, by node."""

    def __init__(self, asset, places):
        super().__init__(asset)
        self.places = places
        roots = asset.json["scenes"][asset.json["scene"]]["nodes"]
        self.drawn = [node for root in roots for node in self.below(root)]

    def all_points(self, upper, clip=None, time=0.0):
        nodes, world = self.pose(clip, time)
        points = np.vstack([self.points(i, nodes, world, None) for i in self.drawn])
        return points @ self.places[upper][:3, :3].T + self.places[upper][:3, 3]

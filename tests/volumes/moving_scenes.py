# SPDX-License-Identifier: Apache-2.0
"""Assets with geometry that moves in many ways, for bounding volumes above it."""
import base64

import numpy as np


class Builder:
    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.data = b""
        self.json = {"asset": {"version": "2.1"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [],
                     "meshes": [], "accessors": [], "bufferViews": []}

    def accessor(self, values, kind, component=5126, target=None, bounds=False):
        values = np.asarray(values, {5126: np.float32, 5123: np.uint16, 5121: np.uint8}[component])
        self.data += b"\0" * (-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": values.nbytes}
        self.data += values.tobytes()
        self.json["bufferViews"].append({**view, **({"target": target} if target else {})})
        described = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component,
                     "count": len(values), "type": kind}
        if bounds:
            rows = values.reshape(len(values), -1).astype(float)
            described.update(min=rows.min(0).tolist(), max=rows.max(0).tolist())
        self.json["accessors"].append(described)
        return len(self.json["accessors"]) - 1

    def cloud(self, count=100, size=(1, 0.6, 0.3)):
        """Triangles on an ellipsoid."""
        points = self.random.normal(size=(count * 3, 3))
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        return points * np.array(size) + self.random.uniform(-0.5, 0.5, 3)

    def mesh(self, positions, **attributes):
        primitive = {"attributes": {"POSITION": self.accessor(positions, "VEC3", target=34962, bounds=True),
                                    **attributes}}
        self.json["meshes"].append({"primitives": [primitive]})
        return len(self.json["meshes"]) - 1

    def node(self, **members):
        self.json["nodes"].append(members)
        return len(self.json["nodes"]) - 1

    def rotation(self):
        q = self.random.normal(size=4)
        return (q / np.linalg.norm(q)).tolist()

    def place(self):
        return {"translation": self.random.uniform(-2, 2, 3).tolist(), "rotation": self.rotation(),
                "scale": self.random.uniform(0.3, 1.5, 3).tolist()}

    def values(self, path, count, targets=0):
        if path == "rotation":
            q = self.random.normal(size=(count, 4))
            q /= np.linalg.norm(q, axis=1, keepdims=True)
            return q
        if path == "weights":
            return self.random.uniform(-0.5, 1.5, (count, targets))
        return self.random.uniform(0.3, 2, (count, 3)) if path == "scale" else self.random.uniform(-2, 2, (count, 3))

    def animate(self, channels, kind="LINEAR", keys=5, targets=0):
        """An animation of (node, path)."""
        times = np.cumsum(self.random.uniform(0.2, 1, keys))
        animation = {"samplers": [], "channels": []}
        source = self.accessor(times, "SCALAR", bounds=True)
        for node, path in channels:
            values = self.values(path, keys, targets)
            if kind == "CUBICSPLINE":
                tangents = self.random.uniform(-0.3, 0.3, (2,) + values.shape)
                values = np.stack([tangents[0], values, tangents[1]], 1)
            width = {"rotation": 4, "weights": 1}.get(path, 3)
            output = self.accessor(values.reshape(-1, width) if width > 1 else values.reshape(-1),
                                   {4: "VEC4", 3: "VEC3", 1: "SCALAR"}[width])
            animation["samplers"].append({"input": source, "output": output, "interpolation": kind})
            animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                          "target": {"node": node, "path": path}})
        self.json.setdefault("animations", []).append(animation)

    def skinned(self, joints, positions):
        """A mesh with random weights over some joints, and its skin."""
        which = self.random.integers(0, len(joints), (len(positions), 4))
        weights = self.random.uniform(0, 1, (len(positions), 4)) ** 3
        weights = (weights / weights.sum(1, keepdims=True)).astype(np.float32)
        for row in which:  # no joint twice
            row[:] = self.random.permutation(len(joints))[:4]
        mesh = self.mesh(positions, JOINTS_0=self.accessor(which, "VEC4", 5121, 34962),
                         WEIGHTS_0=self.accessor(weights, "VEC4", target=34962))
        inverse = []
        for _ in joints:
            matrix = np.eye(4)
            matrix[:3, 3] = self.random.uniform(-0.5, 0.5, 3)
            inverse.append(matrix.T.reshape(-1))
        self.json.setdefault("skins", []).append(
            {"joints": joints, "inverseBindMatrices": self.accessor(np.array(inverse), "MAT4")})
        return {"mesh": mesh, "skin": len(self.json["skins"]) - 1}

    def done(self):
        self.json["buffers"] = [{"byteLength": len(self.data), "uri": "data:application/octet-stream;base64,"
                                 + base64.b64encode(self.data).decode()}]
        return self.json


def static(b):
    b.node(children=[1, 2])
    b.node(mesh=b.mesh(b.cloud()), **b.place())
    b.node(mesh=b.mesh(b.cloud(50)), children=[3], **b.place())
    b.node(mesh=0, **b.place())
    return [0, 1, 2]


def nested(b):
    b.node(children=[1], **b.place())
    for i in range(1, 6):
        b.node(mesh=b.mesh(b.cloud(100)) if i == 1 else 0, **({"children": [i + 1]} if i < 5 else {}), **b.place())
    return [0, 2, 4]


def moving(kind):
    def make(b):
        b.node(children=[1], **b.place())
        b.node(children=[2], **b.place())
        b.node(mesh=b.mesh(b.cloud()), **b.place())
        b.animate([(1, "rotation"), (1, "translation"), (2, "scale")], kind)
        b.animate([(2, "rotation")], kind, 3)
        b.animate([(0, "translation")], kind)  # moves the volume of node 0, too
        return [0, 1, 2]
    return make


def skins(b):
    b.node(children=[1, 7], **b.place())
    for i in range(1, 7):
        b.node(**({"children": [i + 1]} if i < 6 else {}), translation=b.random.uniform(-0.5, 0.5, 3).tolist(),
               rotation=b.rotation())
    b.node(**b.skinned([1, 2, 3, 4, 5, 6], b.cloud(60)))
    b.animate([(i, "rotation") for i in range(1, 7)])
    b.animate([(2, "translation"), (0, "rotation")], "CUBICSPLINE")
    return [0, 7]


def morphs(b):
    b.node(children=[1])
    mesh = b.mesh(b.cloud(60))
    primitive = b.json["meshes"][mesh]["primitives"][0]
    primitive["targets"] = [{"POSITION": b.accessor(b.random.normal(0, 0.3, (180, 3)), "VEC3", target=34962,
                                                    bounds=True)} for _ in range(3)]
    b.json["meshes"][mesh]["weights"] = [0.5, 0, 0.25]
    b.node(mesh=mesh, **b.place())
    b.animate([(1, "weights")], targets=3)
    b.animate([(1, "weights"), (1, "rotation")], "CUBICSPLINE", targets=3)
    return [0, 1]


def copies(b):
    b.node(children=[1])
    instances = {"TRANSLATION": b.accessor(b.random.uniform(-3, 3, (7, 3)), "VEC3"),
                 "ROTATION": b.accessor([b.rotation() for _ in range(7)], "VEC4"),
                 "SCALE": b.accessor(b.random.uniform(0.2, 1, (7, 3)), "VEC3")}
    b.node(mesh=b.mesh(b.cloud()), extensions={"EXT_mesh_gpu_instancing": {"attributes": instances}}, **b.place())
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    b.animate([(1, "rotation")])
    return [0, 1]


def far(b):
    """Far from the origin, and large."""
    b.node(children=[1], translation=[4000, -2000, 100])
    b.node(children=[2], translation=[300, 0, 0])
    b.node(mesh=b.mesh(b.cloud() * 50))
    b.animate([(1, "rotation")], keys=3)
    return [0, 2]


KINDS = {"static": static, "nested": nested, "linear": moving("LINEAR"), "step": moving("STEP"),
         "spline": moving("CUBICSPLINE"), "skinned": skins, "morphed": morphs, "copies": copies, "far": far}


def make(name, seed):
    """An asset, and the nodes that get volumes."""
    builder = Builder(seed)
    nodes = KINDS[name](builder)
    return builder.done(), nodes

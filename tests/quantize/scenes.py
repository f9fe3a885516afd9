# SPDX-License-Identifier: Apache-2.0
"""Scenes whose quantization is easy to get wrong."""
import json
import struct

import numpy as np

KINDS = {"f": 5126, "B": 5121, "H": 5123, "I": 5125, "b": 5120, "h": 5122}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Scene:
    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [],
                     "meshes": [], "accessors": [], "bufferViews": []}
        self.bin = b""

    def accessor(self, values, bounds=False, **members):
        values = np.ascontiguousarray(values)
        values = values.reshape(len(values), -1)
        self.bin += b"\0" * (-len(self.bin) % 8)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bin), "byteLength": values.nbytes})
        self.bin += values.tobytes()
        entry = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": KINDS[values.dtype.char],
                 "count": len(values), "type": TYPES[values.shape[1]], **members}
        if bounds:
            entry |= {"min": values.min(0).tolist(), "max": values.max(0).tolist()}
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def primitive(self, points, normals, coordinates=None, indices=None, **more):
        attributes = {"POSITION": self.accessor(points.astype("f"), True),
                      "NORMAL": self.accessor(normals.astype("f"))}
        if coordinates is not None:
            attributes["TEXCOORD_0"] = self.accessor(coordinates.astype("f"))
        entry = {"attributes": {**attributes, **more.pop("attributes", {})}, **more}
        if indices is not None:
            entry["indices"] = self.accessor(indices.astype("H"))
        return entry

    def mesh(self, *primitives, **more):
        self.json["meshes"].append({"primitives": list(primitives), **more})
        return len(self.json["meshes"]) - 1

    def node(self, root=True, **members):
        self.json["nodes"].append(members)
        if root:
            self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)
        return len(self.json["nodes"]) - 1

    def add(self, table, entry):
        self.json.setdefault(table, []).append(entry)
        return len(self.json[table]) - 1

    def use(self, name, required=False):
        for table in ["extensionsUsed"] + (["extensionsRequired"] if required else []):
            self.json.setdefault(table, []).append(name)

    def glb(self):
        self.bin += b"\0" * (-len(self.bin) % 4)
        self.json["buffers"] = [{"byteLength": len(self.bin)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        return (struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(self.bin), len(text), 0x4E4F534A) + text +
                struct.pack("<II", len(self.bin), 0x004E4942) + self.bin)


def sphere(n=24, radius=1.0, center=(0, 0, 0)):
    """Points, normals, texture coordinates and triangles."""
    v, u = np.mgrid[0:n + 1, 0:2 * n + 1].astype(float)
    a, b = np.pi * v / n, np.pi * u / n
    normals = np.stack([np.sin(a) * np.cos(b), np.cos(a), np.sin(a) * np.sin(b)], -1).reshape(-1, 3)
    coordinates = np.stack([u / (2 * n), v / n], -1).reshape(-1, 2)
    row = 2 * n + 1
    first = (np.arange(n)[:, None] * row + np.arange(2 * n)[None]).ravel()
    triangles = np.stack([first, first + 1, first + row, first + row, first + 1, first + row + 1], 1).ravel()
    return normals * radius + np.array(center), normals, coordinates, triangles


def plain():
    scene = Scene()
    points, normals, coordinates, triangles = sphere(center=(3.3, -1.7, 0.4))
    tangents = np.c_[np.roll(normals, 1, 1), np.where(np.arange(len(normals)) % 2, 1, -1)]
    colors = np.random.default_rng(1).random((len(points), 4))
    attributes = {"TANGENT": scene.accessor(tangents.astype("f")), "COLOR_0": scene.accessor(colors.astype("f")),
                  "COLOR_1": scene.accessor((np.round(colors * 255) / 255).astype("f")[:, :3]),
                  "_ID": scene.accessor(np.arange(len(points), dtype="f"))}
    scene.node(mesh=scene.mesh(scene.primitive(points, normals, coordinates, triangles, attributes=attributes)),
               name="ball", translation=[0.1, 0.2, 0.3], rotation=[0, 0.6, 0, 0.8], scale=[2, 3, 0.5])
    return scene


def wrapped():
    scene = Scene()
    points, normals, coordinates, triangles = sphere()
    scene.node(mesh=scene.mesh(scene.primitive(points, normals, coordinates * 7 - 2, triangles)))
    return scene


def placed():
    """One mesh at nodes that take it up in different ways."""
    scene = Scene()
    mesh = scene.mesh(scene.primitive(*sphere()))
    scene.node(mesh=mesh, translation=[5, 0, 0], scale=[2, 2, 2])
    scene.node(mesh=mesh, matrix=[0, 1, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 0, 4, 0, 1])
    leaf = scene.node(False, name="leaf", translation=[1, 1, 1])
    scene.node(mesh=mesh, children=[leaf], translation=[0, 0, 7], name="parent")
    moving = scene.node(mesh=mesh, translation=[0, -6, 0], name="moving", scale=[0.1, 0.1, 0.1])
    scene.add("cameras", {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}})
    scene.node(mesh=mesh, camera=0, translation=[0, 0, -9])
    times = scene.accessor(np.array([0, 1], "f"), True)
    values = scene.accessor(np.array([[0, -6, 0], [1, -6, 0]], "f"))
    scene.add("animations", {"samplers": [{"input": times, "output": values}],
                             "channels": [{"sampler": 0, "target": {"node": moving, "path": "translation"}}]})
    scene.node(mesh=scene.mesh(scene.primitive(*sphere(radius=0.01))), translation=[2, 2, 2])
    return scene


def seams():
    """Two halves of a ball that share a border, at two nodes with one transform."""
    scene = Scene()
    points, normals, coordinates, triangles = sphere(center=(0.123, 4.56, -7.89))
    half = len(triangles) // 2 // 6 * 6
    for part in (triangles[:half], triangles[half:]):
        used, indices = np.unique(part, return_inverse=True)
        scene.node(mesh=scene.mesh(scene.primitive(points[used], normals[used], coordinates[used], indices)),
                   translation=[0.7, 0, 0], scale=[1.5, 1.5, 1.5])
    return scene


def morphed():
    scene = Scene()
    points, normals, coordinates, triangles = sphere(center=(0, 1, 0))
    random = np.random.default_rng(2)
    targets = [{"POSITION": scene.accessor((normals * random.random((len(points), 1)) * 0.3).astype("f"), True),
                "NORMAL": scene.accessor((random.random(points.shape) * 0.1).astype("f"))} for _ in range(3)]
    scene.node(mesh=scene.mesh(scene.primitive(points, normals, coordinates, triangles, targets=targets),
                               weights=[0.5, 0, 0.25]), name="morph")
    times = scene.accessor(np.array([0, 1], "f"), True)
    values = scene.accessor(np.array([0, 0, 0, 1, 1, 1], "f"))
    scene.add("animations", {"samplers": [{"input": times, "output": values}],
                             "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]})
    return scene


def skinned():
    scene = Scene()
    points, normals, coordinates, triangles = sphere(center=(0, 1, 0))
    height = np.clip(points[:, 1:2] / 2, 0, 1)
    weights = np.c_[1 - height, height * 0.6, height * 0.4, 0 * height]
    attributes = {"JOINTS_0": scene.accessor(np.tile(np.array([0, 1, 2, 0], "H"), (len(points), 1))),
                  "WEIGHTS_0": scene.accessor(weights.astype("f"))}
    mesh = scene.mesh(scene.primitive(points, normals, coordinates, triangles, attributes=attributes))
    tip = scene.node(False, name="tip", translation=[0, 1, 0], rotation=[0, 0, 0.1, 0.99])
    middle = scene.node(False, name="middle", translation=[0, 1, 0], children=[tip], scale=[1.2, 1.2, 1.2])
    root = scene.node(name="root", children=[middle], translation=[0.5, 0, 0])
    inverse = [np.eye(4) for _ in range(3)]
    for i, matrix in enumerate(inverse):
        matrix[:3, 3] = [0, -i, 0]
    matrices = scene.accessor(np.array([each.T.ravel() for each in inverse], "f"))
    scene.add("skins", {"joints": [root, middle, tip], "inverseBindMatrices": matrices})
    scene.node(mesh=mesh, skin=0, name="skinned", translation=[9, 9, 9])
    return scene


def instanced(scaled=True):
    scene = Scene()
    mesh = scene.mesh(scene.primitive(*sphere(center=(1, 0, 0))))
    random = np.random.default_rng(3)
    attributes = {"TRANSLATION": scene.accessor((random.random((50, 3)) * 9).astype("f"))}
    if scaled:
        turns = random.random((50, 4)) - 0.5
        turns /= np.linalg.norm(turns, axis=1, keepdims=True)
        attributes |= {"ROTATION": scene.accessor(turns.astype("f")),
                       "SCALE": scene.accessor((random.random((50, 3)) + 0.5).astype("f"))}
    scene.node(mesh=mesh, extensions={"EXT_mesh_gpu_instancing": {"attributes": attributes}})
    scene.use("EXT_mesh_gpu_instancing", True)
    return scene


def thick():
    scene = Scene()
    material = scene.add("materials", {"extensions": {"KHR_materials_volume": {"thicknessFactor": 0.25},
                                                      "KHR_materials_transmission": {"transmissionFactor": 1}}})
    for x in (0, 3):
        mesh = scene.mesh(scene.primitive(*sphere(radius=1 + x), material=material))
        scene.node(mesh=mesh, translation=[x, 0, 0])
    scene.use("KHR_materials_volume")
    scene.use("KHR_materials_transmission")
    return scene


def shared():
    """Two meshes with common vertices."""
    scene = Scene()
    primitive = scene.primitive(*sphere())
    scene.node(mesh=scene.mesh(primitive), scale=[3, 3, 3])
    scene.node(mesh=scene.mesh(primitive), translation=[4, 0, 0])
    return scene


def pointed():
    """A JSON pointer moves the node."""
    scene = Scene()
    scene.node(mesh=scene.mesh(scene.primitive(*sphere())), translation=[1, 2, 3])
    times = scene.accessor(np.array([0, 1], "f"), True)
    values = scene.accessor(np.array([[1, 2, 3], [4, 2, 3]], "f"))
    pointer = {"KHR_animation_pointer": {"pointer": "/nodes/0/translation"}}
    scene.add("animations", {"samplers": [{"input": times, "output": values}],
                             "channels": [{"sampler": 0, "target": {"path": "pointer", "extensions": pointer}}]})
    scene.use("KHR_animation_pointer")
    return scene


def lit():
    """Extensions at nodes with a mesh."""
    scene = Scene()
    mesh = scene.mesh(scene.primitive(*sphere()))
    scene.use("KHR_lights_punctual")
    scene.use("ACME_label")
    scene.json["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
    scene.node(mesh=mesh, extensions={"KHR_lights_punctual": {"light": 0}}, translation=[1, 0, 0])
    scene.node(mesh=mesh, extensions={"ACME_label": {"text": "ball"}}, translation=[-1, 0, 0])
    return scene


def elsewhere():
    """A mesh that only another scene draws, and mirrored and scaled parents."""
    scene = Scene()
    mesh = scene.mesh(scene.primitive(*sphere()))
    scene.node(mesh=mesh, scale=[-1, 2, 0.001], rotation=[0.5, 0.5, 0.5, 0.5])
    child = scene.node(False, mesh=mesh, scale=[5, 5, 5])
    scene.node(children=[child], scale=[0.01, 0.01, 0.01], rotation=[0, 0, 0.6, 0.8])
    large = scene.mesh(scene.primitive(*sphere(radius=50)))
    scene.json["scenes"].append({"nodes": [scene.node(False, mesh=large, scale=[3, 3, 3])]})
    return scene


def plain_skin():
    """A skin without inverse bind matrices, and its mesh without the skin."""
    scene = skinned()
    del scene.json["skins"][0]["inverseBindMatrices"]
    scene.node(mesh=0, translation=[-5, 0, 0])
    return scene


SCENES = {each.__name__: each for each in (plain, wrapped, placed, seams, morphed, skinned, instanced, thick, shared, pointed, lit,
                                         elsewhere, plain_skin)}
SCENES["instanced-without-scale"] = lambda: instanced(False)

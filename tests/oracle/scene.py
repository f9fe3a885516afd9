# SPDX-License-Identifier: Apache-2.0
"""Writes glTF assets: shapes, materials, lights and cameras in one file with data URIs."""
import base64
import json
import math
import struct

from vectors import cross, facing, normalize, times

COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
FORMATS = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}
FLOAT, UINT, UBYTE = 5126, 5125, 5121


class Shape:
    """Attributes by name, each a list of tuples, and triangles."""

    def __init__(self, triangles, **attributes):
        self.triangles, self.attributes = triangles, attributes

    def having(self, **attributes):
        return Shape(self.triangles, **{**self.attributes, **attributes})

    def without(self, *names):
        kept = {name: value for name, value in self.attributes.items() if name not in names}
        return Shape(self.triangles, **kept)


def quad(half_width=1.0, half_height=None):
    """In z = 0, its front towards +z. Texture coordinates have their origin at the upper left."""
    w, h = half_width, half_height or half_width
    return Shape([(0, 1, 2), (0, 2, 3)], POSITION=[(-w, -h, 0), (w, -h, 0), (w, h, 0), (-w, h, 0)],
                 NORMAL=[(0, 0, 1)] * 4, TEXCOORD_0=[(0, 1), (1, 1), (1, 0), (0, 0)])


def box(x, y, z):
    """Around the origin, half as wide as that; its faces have normals of their own."""
    triangles, positions, normals = [], [], []
    for axis in range(3):
        for sign in (-1, 1):
            normal = tuple(sign * (i == axis) for i in range(3))
            u = tuple(int(i == (axis + 1) % 3) for i in range(3))
            v = cross(normal, u)
            first = len(positions)
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = tuple(n + a * p + b * q for n, p, q in zip(normal, u, v))
                positions.append(tuple(c * half for c, half in zip(corner, (x, y, z))))
                normals.append(normal)
            triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return Shape(triangles, POSITION=positions, NORMAL=normals)


def sphere(radius, bands):
    """With smooth normals; twice as many sectors as bands."""
    sectors = 2 * bands
    normals = [(math.sin(math.pi * i / bands) * math.cos(math.pi * j / bands),
                math.cos(math.pi * i / bands),
                -math.sin(math.pi * i / bands) * math.sin(math.pi * j / bands))
               for i in range(bands + 1) for j in range(sectors + 1)]
    triangles = []
    for i in range(bands):
        for j in range(sectors):
            a = i * (sectors + 1) + j
            b = a + sectors + 1
            triangles += [(a, b, b + 1)] * (i < bands - 1) + [(a, b + 1, a + 1)] * (i > 0)
    return Shape(triangles, POSITION=[times(radius, n) for n in normals], NORMAL=normals)


class Scene:
    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.bytes = bytearray()

    def add(self, array, item):
        """The index of a new object."""
        self.json.setdefault(array, []).append(item)
        return len(self.json[array]) - 1

    def node(self, parent=None, **node):
        index = self.add("nodes", node)
        if parent is None:
            self.json["scenes"][0]["nodes"].append(index)
        else:
            self.json["nodes"][parent].setdefault("children", []).append(index)
        return index

    def view(self, content):
        self.bytes += bytes(-len(self.bytes) % 4)
        offset = len(self.bytes)
        self.bytes += content
        return self.add("bufferViews", {"buffer": 0, "byteOffset": offset,
                                        "byteLength": len(content)})

    def accessor(self, kind, values, component=FLOAT, **more):
        """`values`: numbers, or tuples of them."""
        flat = [v for value in values for v in (value if isinstance(value, tuple) else (value,))]
        count = COMPONENTS[kind]
        content = struct.pack(f"<{len(flat)}{FORMATS[component]}", *flat)
        if component == FLOAT:
            flat = struct.unpack(f"<{len(flat)}f", content)
        bounds = {"min": [min(flat[i::count]) for i in range(count)],
                  "max": [max(flat[i::count]) for i in range(count)]}
        return self.add("accessors", {"bufferView": self.view(content), "componentType": component,
                                      "count": len(values), "type": kind, **bounds, **more})

    # What is drawn.

    def mesh(self, shape, material, **more):
        attributes = {}
        for name, values in shape.attributes.items():
            integers = isinstance(values[0][0], int) and name.startswith("COLOR")
            component, extra = (UBYTE, {"normalized": True}) if integers else (FLOAT, {})
            attributes[name] = self.accessor(f"VEC{len(values[0])}", values, component, **extra)
        indices = [corner for triangle in shape.triangles for corner in triangle]
        return self.add("meshes", {"primitives": [
            {"attributes": attributes, "indices": self.accessor("SCALAR", indices, UINT),
             "material": self.add("materials", material)}], **more})

    def draw(self, shape, material, parent=None, **node):
        return self.node(parent, mesh=self.mesh(shape, material), **node)

    def texture(self, content, **sampler):
        """The index of a texture with the bytes of a PNG."""
        uri = "data:image/png;base64," + base64.b64encode(content).decode()
        return self.add("textures", {"source": self.add("images", {"uri": uri}),
                                     "sampler": self.add("samplers", sampler)})

    # Lights and cameras.

    def light(self, kind, parent=None, place=None, **light):
        lights = self.json.setdefault("extensions", {}).setdefault(
            "KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"type": kind, **light})
        return self.node(parent, extensions={"KHR_lights_punctual": {"light": len(lights) - 1}},
                         **(place or {}))

    def sun(self, toward, lux, **light):
        """Parallel light from that direction."""
        self.light("directional", place={"rotation": facing(toward)}, intensity=lux, **light)

    def camera(self, camera, **node):
        return self.node(camera=self.add("cameras", camera), **node)

    def seen_from(self, toward=(0, 0, 1), half=1e-5, at=(0, 0, 0), distance=4.0):
        """An orthographic camera in that direction of a point that it looks at. By default its
        picture is so small that everything in it is the point."""
        place = tuple(p + distance * c for p, c in zip(at, normalize(toward)))
        return self.camera(orthographic(half, half), translation=place, rotation=facing(toward))

    def text(self):
        document = dict(self.json)
        used = sorted(names_in(document).union(self.json.get("extensionsUsed", [])))
        if used:
            document["extensionsUsed"] = used
        if self.bytes:
            uri = "data:application/octet-stream;base64," + base64.b64encode(self.bytes).decode()
            document["buffers"] = [{"byteLength": len(self.bytes), "uri": uri}]
        return json.dumps(document)


def names_in(value):
    """Names of extensions anywhere in a document."""
    if isinstance(value, dict):
        found = set(value["extensions"]) if isinstance(value.get("extensions"), dict) else set()
        return found.union(*map(names_in, value.values()))
    return set().union(*map(names_in, value)) if isinstance(value, list) else set()


def orthographic(xmag, ymag):
    return {"type": "orthographic",
            "orthographic": {"xmag": xmag, "ymag": ymag, "znear": 0.01, "zfar": 1000}}


def perspective(yfov, **more):
    return {"type": "perspective", "perspective": {"yfov": yfov, "znear": 0.01, **more}}


# Materials, as the text of the specification names their properties.

def material(base_color=(1, 1, 1), metallic=0.0, roughness=1.0, alpha=1.0, extensions=None, **more):
    """`extensions`: by the name without KHR_materials_."""
    result = {"pbrMetallicRoughness": {
        "baseColorFactor": [*base_color, alpha], "metallicFactor": metallic,
        "roughnessFactor": roughness}, **more}
    if extensions:
        result["extensions"] = {f"KHR_materials_{k}": v for k, v in extensions.items()}
    return result


NO_SPECULAR = {"specular": {"specularFactor": 0}}


def lambert(base_color=(1, 1, 1), extensions=None, **more):
    """Diffuse only: without the weight of its specular layer, a dielectric is its base."""
    return material(base_color, extensions={**NO_SPECULAR, **(extensions or {})}, **more)


def lamp(radiance=(1, 1, 1), **more):
    """Shines evenly and reflects nothing."""
    strength = max(1, *radiance)
    shining = {"emissive_strength": {"emissiveStrength": strength}} if strength > 1 else None
    return lambert((0, 0, 0), shining, emissiveFactor=[c / strength for c in radiance], **more)

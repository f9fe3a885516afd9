# SPDX-License-Identifier: Apache-2.0
"""Imports the assets whose paths come line by line, and prints the objects of Blender for each."""
import hashlib
import json
import sys

import bpy
import numpy

if "bool" not in vars(numpy):  # the importer of Blender 3.4 asks for a name that numpy 1.24 no longer has
    numpy.bool = bool


def number(value):
    return round(float(value), 4) + 0.0


def plain(value):
    """A value of Blender as JSON: numbers rounded, data blocks by name."""
    if isinstance(value, (bool, str, int, type(None))):
        return value
    if isinstance(value, float):
        return number(value)
    if isinstance(value, bpy.types.ID):
        return value.name
    if hasattr(value, "to_list"):
        return [plain(item) for item in value.to_list()]
    if hasattr(value, "to_dict"):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    try:
        return [plain(item) for item in value]
    except TypeError:
        return str(type(value).__name__)


SKIPPED = {"rna_type", "bl_rna", "name_full", "session_uuid", "original", "preview", "filepath", "filepath_raw",
           "users", "location_absolute", "is_evaluated", "asset_data", "library_weak_reference", "tag", "tag_update"}


def members(thing):
    """What can be read of a structure, without structures inside."""
    out = {}
    for prop in thing.bl_rna.properties:
        if prop.identifier in SKIPPED or prop.type == "COLLECTION":
            continue
        value = getattr(thing, prop.identifier, None)
        if prop.type == "POINTER":
            value = value.name if isinstance(value, bpy.types.ID) else None
        out[prop.identifier] = plain(value)
    out["custom"] = {key: plain(thing[key]) for key in thing.keys()} if hasattr(thing, "keys") else {}
    return out


def nodes(tree):
    return {
        "nodes": [[members(node), [[socket.name, plain(getattr(socket, "default_value", None))] for socket in node.inputs],
                   image_user(node)] for node in tree.nodes],
        "links": [[link.from_node.name, link.from_socket.name, link.to_node.name, link.to_socket.identifier] for link in tree.links],
    }


def image_user(node):
    image = getattr(node, "image", None)
    return pixels(image) if image else None


seen = {}  # of an asset: values of its images by name


def values(image):
    """All values as an array, read once for each image of an asset."""
    if image.name not in seen:
        image.update()
        seen[image.name] = numpy.empty(len(image.pixels), numpy.float32)
        image.pixels.foreach_get(seen[image.name])
    return seen[image.name]


def pixels(image):
    read = values(image)
    rounded = numpy.round(read.astype(numpy.float64) * 255).astype(numpy.int64)
    return [list(image.size), hashlib.sha256(rounded.tobytes()).hexdigest()[:12] if len(read) else ""]


def samples(image):
    """The colors in the middle of each quarter, in fifths: the same for lossy images, and for other sizes."""
    width, height = image.size
    read = values(image)
    if not len(read):
        return []
    def encoded(v):  # float images are held in linear values
        linear = image.is_float and image.colorspace_settings.name == "sRGB"
        return v if not linear else 12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055
    starts = [((height * y // 4) * width + width * x // 4) * 4 for y in (1, 3) for x in (1, 3)]
    return [[round(5 * encoded(float(v))) for v in read[start:start + 3]] + [round(5 * float(read[start + 3]))] for start in starts]


def curves(action):
    return sorted([curve.data_path, curve.array_index, [[number(key.co[0]), number(key.co[1]), key.interpolation,
                   [number(x) for x in (*key.handle_left, *key.handle_right)]] for key in curve.keyframe_points]] for curve in action.fcurves)


def mesh_data(mesh):
    return {
        "points": [[number(x) for x in v.co] for v in mesh.vertices],
        "edges": [list(edge.vertices) for edge in mesh.edges],
        "faces": [[list(face.vertices), face.use_smooth, face.material_index] for face in mesh.polygons],
        "uv": [[layer.name, [[number(x) for x in item.uv] for item in layer.data]] for layer in mesh.uv_layers],
        "attributes": [[it.name, it.domain, it.data_type, [plain(getattr(item, "color", getattr(item, "vector", getattr(item, "value", None)))) for item in it.data]]
                       for it in mesh.attributes if not it.name.startswith(".")],
        "keys": [[key.name, number(key.value), [[number(x) for x in item.co] for item in key.data]] for key in mesh.shape_keys.key_blocks] if mesh.shape_keys else [],
        "custom": {key: plain(mesh[key]) for key in mesh.keys()},
    }


def everything():
    data = bpy.data
    return {
        "objects": [[members(it), [number(x) for row in it.matrix_world for x in row], [[slot.link, slot.material and slot.material.name] for slot in it.material_slots],
                     [group.name for group in it.vertex_groups], [[m.type, m.object and m.object.name] for m in it.modifiers if m.type == "ARMATURE"],
                     weights(it)] for it in data.objects],
        "meshes": [[it.name, mesh_data(it)] for it in data.meshes],
        "materials": [[members(it), nodes(it.node_tree) if it.node_tree else None] for it in data.materials],
        "groups": [[it.name, nodes(it)] for it in data.node_groups],
        "images": [[it.name, it.colorspace_settings.name, it.alpha_mode, pixels(it)] for it in data.images],
        "lights": [members(it) for it in data.lights],
        "cameras": [members(it) for it in data.cameras],
        "armatures": [[it.name, [[bone.name, bone.parent and bone.parent.name, [number(x) for row in bone.matrix_local for x in row]] for bone in it.bones]] for it in data.armatures],
        "actions": [[it.name, curves(it)] for it in data.actions],
        "scenes": [[it.name, {key: plain(it[key]) for key in it.keys()}, [o.name for o in it.objects]] for it in data.scenes],
    }


def weights(thing):
    if thing.type != "MESH" or not thing.vertex_groups:
        return None
    return [sorted([item.group, number(item.weight)] for item in v.groups) for v in thing.data.vertices]


def facts():
    parts, skin = [], []
    graph = bpy.context.evaluated_depsgraph_get()
    for thing in bpy.context.scene.objects:
        if thing.type != "MESH":
            continue
        posed = thing.evaluated_get(graph).to_mesh()
        skin.append([[number(x) for x in thing.matrix_world @ v.co] for v in posed.vertices])
        parts.append(part(thing))
    return {
        "parts": parts,
        "skin": [[[round(x, 2) for x in v] for v in it] for it in skin],
        "names": sorted([it.name for it in bpy.data.objects] + [bone.name for it in bpy.data.armatures for bone in it.bones]),
        "nodes": sorted([it.name, [round(number(x), 3) for row in it.matrix_world for x in row]] for it in bpy.data.objects),
        "moved": sorted(it.data.name if it.data else it.name for it in bpy.data.objects
                        if it.animation_data and (it.animation_data.action or it.animation_data.nla_tracks)),
        "animations": sorted(track.name for it in bpy.data.objects if it.animation_data for track in it.animation_data.nla_tracks),
        "lights": sum(it.type == "LIGHT" for it in bpy.data.objects),
        "morphs": [len(it.shape_keys.key_blocks) - 1 if it.shape_keys else 0 for it in bpy.data.meshes],
        "tracks": sorted([[path.split(".")[-1], index, [[round(x, 2) if isinstance(x, float) else x for x in key[:3]] for key in keys]] for it in bpy.data.actions for path, index, keys in curves(it)]),
        "images": sorted(pixels(it) for it in bpy.data.images),
        "pixels": [samples(it) for it in bpy.data.images],
    }


def part(thing):
    """The triangles, else the edges, else the points of a mesh."""
    mesh = thing.data
    place = thing.matrix_world
    mesh.calc_loop_triangles()
    if mesh.loop_triangles:
        mesh.calc_normals_split()
        loops = [index for face in mesh.loop_triangles for index in face.loops]
        corner = {"POSITION": [list(place @ mesh.vertices[mesh.loops[i].vertex_index].co) for i in loops],
                  "NORMAL": [list(mesh.loops[i].normal) for i in loops]}
        for n, layer in enumerate(mesh.uv_layers[:2]):
            corner[f"TEXCOORD_{n}"] = [list(layer.data[i].uv) for i in loops]
        for color in mesh.color_attributes[:1]:
            corner["COLOR_0"] = [list(color.data[i if color.domain == "CORNER" else mesh.loops[i].vertex_index].color) for i in loops]
        return {"mode": 4, "index": None, "count": len(loops), "attributes": corner}
    points = [list(place @ v.co) for v in mesh.vertices]
    if mesh.edges:
        order = [index for edge in mesh.edges for index in edge.vertices]
        return {"mode": 1, "index": order, "count": len(order), "attributes": {"POSITION": points}}
    return {"mode": 0, "index": None, "count": len(points), "attributes": {"POSITION": points}}


def answer(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    seen.clear()
    try:
        bpy.ops.import_scene.gltf(filepath=path)
    except Exception as error:
        return {"refused": str(error)}
    bpy.context.view_layer.update()
    try:
        return {"dump": json.dumps(everything(), sort_keys=True), "facts": facts()}
    except Exception as error:
        return {"refused": f"harness: {error!r}"}


for line in sys.stdin:
    print(f"\nANSWER {line.strip()}\t" + json.dumps(answer(line.strip())), flush=True)

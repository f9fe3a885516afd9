# SPDX-License-Identifier: Apache-2.0
"""Constructs that no schema file describes: graphs, shared use, text, containers and images."""
import struct

import assets
from assets import PNG_URI, base, data_uri, link, merged, text_of


def finished(more, used=()):
    asset = merged(base(), more)
    asset["extensionsUsed"] = asset["extensionsUsed"] + list(used)
    return text_of(link(asset, base()))


def raw(members):
    """The base asset with text after its members."""
    return text_of(base())[:-1] + b"," + members.encode() + b"}"


def deep_nodes(n):
    asset = base()
    first = len(asset["nodes"])
    asset["nodes"] += [{"children": [first + i + 1]} for i in range(n - 1)] + [{"mesh": 0}]
    asset["scenes"][0]["nodes"].append(first)
    return text_of(asset)


def wide_nodes(n):
    asset = base()
    first = len(asset["nodes"])
    asset["nodes"] += [{} for _ in range(n)] + [{"children": list(range(first, first + n))}]
    asset["scenes"][0]["nodes"].append(first + n)
    return text_of(asset)


def cycle(n):
    asset = base()
    first = len(asset["nodes"])
    asset["nodes"] += [{"children": [first + (i + 1) % n]} for i in range(n)]
    return text_of(asset)


def many_parents(n):
    asset = base()
    first = len(asset["nodes"])
    asset["nodes"] += [{"children": [0]} for i in range(n)]
    asset["scenes"][0]["nodes"] = list(range(1, first + n))
    return text_of(asset)


def every_scene(n):
    return finished({"scenes": [{"nodes": [0, 1]} for _ in range(n)]})


def instances(n):
    return finished({"nodes": [{"mesh": 0, "translation": [i, 0, 0]} for i in range(n)]})


def shared_primitives(n):
    return finished({"meshes": [{"primitives": base()["meshes"][0]["primitives"] * n}]})


def primitives_in_nodes(n):
    half = max(int(n**0.5), 1)
    meshes = [{"primitives": base()["meshes"][0]["primitives"] * half}]
    return finished({"meshes": meshes, "nodes": [{"mesh": 1}] * half})


def own_materials(n):
    drawn = base()["meshes"][0]["primitives"][0]
    return finished({"materials": [{"name": f"m{i}"} for i in range(n)],
                     "meshes": [{"primitives": [{**drawn, "material": 1 + i} for i in range(n)]}]})


def morph_targets(n):
    drawn = base()["meshes"][0]["primitives"][0]
    return finished({"meshes": [{"primitives": [{**drawn, "targets": [{"POSITION": 0}] * n}],
                                 "weights": [0] * n}]})


def targets_by_primitives(n):
    half = max(int(n**0.5), 1)
    drawn = {**base()["meshes"][0]["primitives"][0], "targets": [{"POSITION": 0}] * half}
    return finished({"meshes": [{"primitives": [drawn] * half, "weights": [0] * half}]})


def attribute_sets(n):
    drawn = base()["meshes"][0]["primitives"][0]
    sets = {f"TEXCOORD_{i}": assets.TEXCOORD for i in range(n)}
    return finished({"meshes": [{"primitives": [{**drawn, "attributes":
                                                 {**drawn["attributes"], **sets}}]}]})


def joint_sets(n):
    sets = {f"JOINTS_{i}": assets.JOINTS for i in range(n)}
    sets |= {f"WEIGHTS_{i}": assets.WEIGHTS for i in range(n)}
    drawn = base()["meshes"][0]["primitives"][0]
    return finished({"meshes": [{"primitives": [{"attributes": {**drawn["attributes"], **sets}}]}],
                     "nodes": [{"mesh": 1, "skin": 0}]})


def joints(n):
    asset = base()
    first = len(asset["nodes"])
    asset["nodes"] += [{"children": [first + i + 1]} for i in range(n - 1)] + [{}]
    asset["skins"].append({"joints": list(range(first, first + n)), "skeleton": first})
    asset["scenes"][0]["nodes"].append(first)
    return text_of(asset)


def skinned_instances(n):
    drawn = {"attributes": {"POSITION": 0, "JOINTS_0": assets.JOINTS, "WEIGHTS_0": assets.WEIGHTS}}
    return finished({"meshes": [{"primitives": [drawn]}], "nodes": [{"mesh": 1, "skin": 0}] * n})


def skin_of_scale_0(n):
    """Nodes of one skin, all of whose joints are below a node that is scaled to 0."""
    drawn = {"attributes": {"POSITION": 0, "JOINTS_0": assets.JOINTS, "WEIGHTS_0": assets.WEIGHTS}}
    asset = base()
    first, mesh, skin = len(asset["nodes"]), len(asset["meshes"]), len(asset["skins"])
    below = list(range(first + 1, first + 1 + n))
    asset["meshes"].append({"primitives": [drawn]})
    asset["skins"].append({"joints": below})
    asset["nodes"] += [{"scale": [0, 0, 0], "children": below}] + [{}] * n + [{"mesh": mesh, "skin": skin}] * n
    asset["scenes"] = [{"nodes": [first] + list(range(first + 1 + n, first + 1 + 2 * n))}]
    return text_of(asset)


def skins(n):
    return finished({"skins": [{"joints": [0, 1], "inverseBindMatrices": assets.MATRIX}] * n})


def animations(n):
    return finished({"animations": [assets.animation(0) for _ in range(n)]})


def channels(n):
    nodes = [{} for _ in range(n)]
    one = assets.animation(0)
    one["channels"] = [{"sampler": 0, "target": {"node": 2 + i, "path": "rotation"}}
                       for i in range(n)]
    return finished({"nodes": nodes, "animations": [one]})


def same_channels(n):
    one = assets.animation(0)
    one["channels"] *= n
    return finished({"animations": [one]})


def animation_samplers(n):
    one = assets.animation(0)
    one["samplers"] *= n
    one["channels"] = [{"sampler": i, "target": {"node": 0, "path": "rotation"}} for i in range(n)]
    return finished({"animations": [one]})


def keyframes(n):
    times = struct.pack(f"<{n}f", *range(n))
    values = struct.pack("<4f", 0, 0, 0, 1) * n
    more = {
        "buffers": [{"uri": data_uri(times + values), "byteLength": 20 * n}],
        "bufferViews": [{"buffer": 1, "byteLength": 4 * n},
                        {"buffer": 1, "byteOffset": 4 * n, "byteLength": 16 * n}],
        "accessors": [{"bufferView": 9, "componentType": 5126, "count": n, "type": "SCALAR",
                       "min": [0], "max": [n - 1]},
                      {"bufferView": 10, "componentType": 5126, "count": n, "type": "VEC4"}],
        "animations": [{"samplers": [{"input": 9, "output": 10}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}],
    }
    return finished(more)


def pointer_channels(pointer):
    def build(n):
        target = {"path": "pointer"}
        one = {"samplers": [{"input": assets.TIMES, "output": assets.TIMES}],
               "channels": [{"sampler": 0, "target": {**target, "extensions": {
                   "KHR_animation_pointer": {"pointer": pointer.format(i)}}}} for i in range(n)]}
        return finished({"animations": [one], "materials": [
            {"extensions": {"KHR_materials_translucency": {"translucencyFactor": 1}}}] * n},
            ["KHR_animation_pointer"])
    return build


def sparse(n):
    return finished({"accessors": [{
        "componentType": 5126, "count": 3, "type": "VEC3", "sparse": {
            "count": 1, "indices": {"bufferView": assets.INDICES, "componentType": 5125},
            "values": {"bufferView": assets.NORMAL}}} for _ in range(n)]})


def sparse_elements(n):
    data = struct.pack(f"<{n}I", *range(n)) + bytes(12 * n)
    return finished({
        "buffers": [{"uri": data_uri(data), "byteLength": len(data)}],
        "bufferViews": [{"buffer": 1, "byteLength": 4 * n},
                        {"buffer": 1, "byteOffset": 4 * n, "byteLength": 12 * n}],
        "accessors": [{"componentType": 5126, "count": n, "type": "VEC3", "sparse": {
            "count": n, "indices": {"bufferView": 9, "componentType": 5125},
            "values": {"bufferView": 10}}}]})


def names(kind):
    def build(n):
        asset = base()
        asset["extensionsUsed"] += [kind.format(i) for i in range(n)]
        return text_of(asset)
    return build


def required(n):
    asset = base()
    listed = [f"ACME_{i}" for i in range(n)]
    asset["extensionsUsed"] += listed
    asset["extensionsRequired"] = listed
    return text_of(asset)


def unknown_objects(n):
    return finished({"extensions": {f"ACME_{i}": {"a": [i]} for i in range(n)}})


def suppressions(n):
    return finished({"extras": {"gltfx": {"ignore": [f"CODE_{i}" for i in range(n)]}},
                     "nodes": [{"extras": {"gltfx": {"ignore": ["UNUSED_OBJECT"]}}}] * n})


def variants(n):
    asset = base()
    asset["extensionsUsed"].append("KHR_materials_variants")
    asset["extensions"] = {"KHR_materials_variants": {"variants": [{"name": f"v{i}"}
                                                                   for i in range(n)]}}
    drawn = asset["meshes"][0]["primitives"][0]
    drawn["extensions"] = {"KHR_materials_variants": {"mappings": [
        {"material": 0, "variants": [i]} for i in range(n)]}}
    return text_of(asset)


def mapped_variants(n):
    asset = base()
    asset["extensionsUsed"].append("KHR_materials_variants")
    asset["extensions"] = {"KHR_materials_variants": {"variants": [{"name": f"v{i}"}
                                                                   for i in range(n)]}}
    drawn = asset["meshes"][0]["primitives"][0]
    drawn["extensions"] = {"KHR_materials_variants": {"mappings": [
        {"material": 0, "variants": list(range(n))}]}}
    return text_of(asset)


def lights(n):
    asset = base()
    asset["extensionsUsed"].append("KHR_lights_punctual")
    asset["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}] * n}}
    asset["nodes"] += [{"extensions": {"KHR_lights_punctual": {"light": i}}} for i in range(n)]
    return text_of(link(asset, base()))


def shared_light(n):
    asset = base()
    asset["extensionsUsed"].append("KHR_lights_punctual")
    asset["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "spot"}]}}
    asset["nodes"] += [{"extensions": {"KHR_lights_punctual": {"light": 0}}}] * n
    return text_of(link(asset, base()))


def packets(legacy):
    name = "KHR_xmp" if legacy else "KHR_xmp_json_ld"

    def build(n):
        asset = base()
        asset["extensionsUsed"].append(name)
        context = {"dc": "http://purl.org/dc/elements/1.1/"}
        packet = {"dc:title": "x"} if legacy else {"@context": context, "dc:title": "x"}
        root = {"packets": [packet] * n}
        asset["extensions"] = {name: {"@context": context, **root} if legacy else root}
        asset["nodes"] += [{"extensions": {name: {"packet": i}}} for i in range(n)]
        return text_of(link(asset, base()))
    return build


def packet_members(name):
    def build(n):
        asset = base()
        asset["extensionsUsed"].append(name)
        context = {f"p{i}": f"http://x/{i}" for i in range(n)}
        members = {f"p{i}:a": "x" for i in range(n)}
        root = ({"@context": context, "packets": [members]} if name == "KHR_xmp"
                else {"packets": [{"@context": context, **members}]})
        asset["extensions"] = {name: root}
        asset["asset"]["extensions"] = {name: {"packet": 0}}
        return text_of(asset)
    return build


def legacy_materials(extension, value):
    def build(n):
        return finished({"materials": [{"name": f"m{i}", "extensions": {extension: value}}
                                       for i in range(n)]}, [extension])
    return build


def legacy_drawn(n):
    drawn = base()["meshes"][0]["primitives"][0]
    value = {"KHR_materials_translucency": {"translucencyFactor": 0.5,
                                            "translucencyTexture": {"index": 0}}}
    return finished({"materials": [{"extensions": value} for _ in range(n)],
                     "meshes": [{"primitives": [{**drawn, "material": 1 + i} for i in range(n)]}]})


def legacy_textures(n):
    value = "KHR_materials_translucency"
    return finished({
        "textures": [{"source": 0, "sampler": 0} for _ in range(n)],
        "materials": [{"extensions": {value: {"translucencyFactor": 0.5, "translucencyTexture": {
            "index": 1 + i}}}} for i in range(n)]})


def legacy_images(n):
    value = "KHR_materials_translucency"
    return finished({
        "images": [{"uri": PNG_URI, "name": f"i{i}"} for i in range(n)],
        "textures": [{"source": 1 + i} for i in range(n)],
        "materials": [{"extensions": {value: {"translucencyFactor": 0.5, "translucencyTexture": {
            "index": 1 + i}}}} for i in range(n)]})


def inside_out(by_mesh):
    """Closed surfaces that face inward: in a mesh and a node each, or as primitives of one mesh."""
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
    data = b"".join(struct.pack("<3f", *corners[i]) for face in faces for i in face)
    primitive = {"attributes": {"POSITION": 0}, "material": 0}

    def build(n):
        meshes = [{"primitives": [primitive]}] * n if by_mesh else [{"primitives": [primitive] * n}]
        nodes = [{"mesh": i, "translation": [2 * i, 0, 0]} for i in range(len(meshes))]
        return text_of({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
            "meshes": meshes, "materials": [{"name": "x" * n}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 12, "min": [0, 0, 0],
                           "max": [1, 1, 1]}],
            "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
            "buffers": [{"uri": data_uri(data), "byteLength": len(data)}]})
    return build


def glb(chunks, json=None):
    text = json or text_of(base())
    text += b" " * (-len(text) % 4)
    body = struct.pack("<II", len(text), 0x4E4F534A) + text + chunks
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def ktx2_levels(n):
    head = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I", 37, 1, 1, 1, 0, 0, 1, n, 0)
    image = data_uri(head + bytes(32 + 24 * n), "image/ktx2")
    return finished({"images": [{"uri": image}], "textures": [
        {"extensions": {"KHR_texture_basisu": {"source": 1}}}]}, ["KHR_texture_basisu"])


def png_chunks(n):
    data = assets._png()
    chunk = struct.pack(">I", 0) + b"tEXt" + struct.pack(">I", 0x97BDF0E2)
    return finished({"images": [{"uri": data_uri(data[:33] + chunk * n + data[33:], "image/png")}]})


CONSTRUCTS = {
    "nodes deep": deep_nodes,
    "nodes wide": wide_nodes,
    "nodes in a cycle": cycle,
    "nodes that are parents of one": many_parents,
    "scenes of the same nodes": every_scene,
    "instances of a mesh": instances,
    "primitives that share all": shared_primitives,
    "primitives times nodes": primitives_in_nodes,
    "primitives with a material each": own_materials,
    "targets of a primitive": morph_targets,
    "targets times primitives": targets_by_primitives,
    "texture coordinate sets": attribute_sets,
    "joint sets": joint_sets,
    "joints deep": joints,
    "skinned instances": skinned_instances,
    "skins of the same joints": skins,
    "nodes of a skin of scale 0": skin_of_scale_0,
    "animations of one node": animations,
    "channels of a node each": channels,
    "channels that are the same": same_channels,
    "samplers of one animation": animation_samplers,
    "keyframes": keyframes,
    "pointers to one property": pointer_channels("/nodes/0/translation"),
    "pointers to a property each": pointer_channels("/materials/{}/alphaCutoff"),
    "pointers into legacy objects": pointer_channels(
        "/materials/{}/extensions/KHR_materials_translucency/translucencyFactor"),
    "pointers that lead nowhere": pointer_channels("/nowhere/{}/x"),
    "sparse accessors": sparse,
    "sparse elements": sparse_elements,
    "extension names, each unknown": names("ACME_{}"),
    "extension names, all the same": names("KHR_materials_unlit"),
    "extension names, slips": names("KHR_materials_unlit{}"),
    "extension names without a prefix": names("x{}"),
    "extensions that are required": required,
    "extension objects, each unknown": unknown_objects,
    "suppressions": suppressions,
    "variants with a mapping each": variants,
    "variants of one mapping": mapped_variants,
    "lights with a node each": lights,
    "nodes of one light": shared_light,
    "legacy packets with a node each": packets(True),
    "packets with a node each": packets(False),
    "members of a legacy packet": packet_members("KHR_xmp"),
    "members of a packet": packet_members("KHR_xmp_json_ld"),
    "legacy: translucency": legacy_materials("KHR_materials_translucency", {"translucencyFactor": 1}),
    "legacy: 3DS": legacy_materials("3DS_materials_translucency", {"translucencyFactor": 1}),
    "legacy: specular-glossiness": legacy_materials(
        "KHR_materials_pbrSpecularGlossiness", {"diffuseFactor": [1, 0, 0, 1]}),
    "legacy: specular-glossiness, textured": legacy_materials(
        "KHR_materials_pbrSpecularGlossiness", {"diffuseTexture": {"index": 0}}),
    "legacy: sss": legacy_materials("KHR_materials_sss", {"scatterDistance": 1}),
    "legacy: subsurface": legacy_materials("KHR_materials_subsurface", {"scatterDistance": 1}),
    "legacy: thin transparency": legacy_materials(
        "ADOBE_materials_thin_transparency", {"transmissionFactor": 1}),
    "legacy: without effect": legacy_materials("KHR_materials_translucency", {}),
    "legacy: broken": legacy_materials("KHR_materials_translucency", {"translucencyFactor": "1"}),
    "legacy materials of a primitive each": legacy_drawn,
    "legacy materials of a texture each": legacy_textures,
    "legacy materials of an image each": legacy_images,
    "unknown members": lambda n: raw(",".join(f'"k{i}":{i}' for i in range(n))),
    "duplicate keys": lambda n: raw(",".join('"k":1' for i in range(n))),
    "duplicate keys of the schema": lambda n: raw(",".join('"scene":0' for i in range(n))),
    "duplicate names in extras": lambda n: raw('"extras":{' + ",".join(
        f'"k{i % 100}":1' for i in range(n)) + "}"),
    "extras: numbers": lambda n: raw('"extras":[' + ",".join("1" for i in range(n)) + "]"),
    "extras: mixed values": lambda n: raw('"extras":[' + ",".join('"a",[],{}' for i in range(n)) + "]"),
    "extras: a long string": lambda n: raw('"extras":"' + "x" * 40 * n + '"'),
    "extras: escapes": lambda n: raw('"extras":"' + "\\u0041" * n + '"'),
    "an unknown member with a long name": lambda n: raw('"' + "x" * 40 * n + '":1'),
    "a long name": lambda n: finished({"materials": [{"name": "x" * 40 * n}]}),
    "names with escapes": lambda n: finished({"nodes": [{"name": "\x1b\n"}] * n}),
    "lines": lambda n: text_of(base()) + b"\n" * n,
    "deep arrays": lambda n: raw('"extras":' + "[" * min(n, 200) + "]" * min(n, 200)),
    "deep arrays beyond the limit": lambda n: raw('"extras":' + "[" * n + "]" * n),
    "values of a wrong type": lambda n: finished({"nodes": [{"mesh": "x"} for _ in range(n)]}),
    "numbers out of range": lambda n: finished({"materials": [{"alphaCutoff": -1}] * n}),
    "references that lead nowhere": lambda n: finished({"nodes": [{"mesh": 9 + i} for i in range(n)]}),
    "images of one file": lambda n: finished({"images": [{"uri": "nothing.png"}] * n}),
    "images of a file each": lambda n: finished({"images": [{"uri": f"i{i}.png"} for i in range(n)]}),
    "images in data URIs": lambda n: finished({"images": [{"uri": PNG_URI}] * n}),
    "images that are drawn": lambda n: finished({
        "images": [{"uri": PNG_URI}] * n, "textures": [{"source": 1 + i} for i in range(n)],
        "materials": [{"emissiveTexture": {"index": 1 + i}} for i in range(n)]}),
    "textures of one image": lambda n: finished({"textures": [{"source": 0}] * n, "materials": [
        {"normalTexture": {"index": 1 + i}, "emissiveTexture": {"index": 1 + i}} for i in range(n)]}),
    "buffers of one file": lambda n: finished({"buffers": [
        {"uri": "large.bin", "byteLength": 20000}] * n}),
    "buffers in data URIs": lambda n: finished({"buffers": [
        {"uri": data_uri(bytes(8)), "byteLength": 8}] * n}),
    "views of one buffer": lambda n: finished({"bufferViews": [{"buffer": 0, "byteLength": 4}] * n}),
    "accessors of one view": lambda n: finished({"accessors": base()["accessors"][:1] * n}),
    "meshes inside out": inside_out(True),
    "primitives inside out": inside_out(False),
    "chunks of a GLB": lambda n: glb(struct.pack("<II", 0, 0x12345678) * n),
    "bytes after a GLB": lambda n: glb(b"") + bytes(n),
    "levels of a KTX2 image": ktx2_levels,
    "chunks of a PNG image": png_chunks,
}

# SPDX-License-Identifier: Apache-2.0
"""Reads the assets whose paths come line by line, and prints the meshes and materials that Open3D makes of each."""
import hashlib
import json
import os
import sys
import tempfile

import numpy
import open3d

IMAGES = ("albedo_img", "normal_img", "ao_img", "roughness_img", "metallic_img", "ao_rough_metal_img", "reflectance_img",
          "clearcoat_img", "clearcoat_roughness_img", "anisotropy_img")


def rounded(values):
    return (numpy.round(numpy.asarray(values, numpy.float64), 4) + 0.0).tolist()


def digest(image):
    data = numpy.asarray(image)
    return [list(data.shape), hashlib.sha256(data.tobytes()).hexdigest()[:12]]


def samples(image):
    """The colors in the middle of each quarter, in fifths: the same for lossy images, and for other sizes."""
    data = numpy.asarray(image)
    scale = numpy.iinfo(data.dtype).max if data.dtype.kind == "u" else 1
    height, width = data.shape[:2]
    return [numpy.atleast_1d(numpy.round(5.0 * data[height * y // 4, width * x // 4] / scale)).tolist() for y in (1, 3) for x in (1, 3)]


def held(material):
    return [(name, getattr(material, name)) for name in IMAGES if getattr(material, name) and not getattr(material, name).is_empty()]


def values(material):
    out = {}
    for name in dir(material):
        value = None if name.startswith("_") or name.endswith("_img") or name == "gradient" else getattr(material, name)
        if isinstance(value, dict):
            out[name] = sorted(value)
        elif value is not None:
            out[name] = value if isinstance(value, (str, bool)) else rounded(value)
    return {**out, **{name: digest(image) for name, image in held(material)}}


def lists(mesh):
    return {name: rounded(getattr(mesh, name)) for name in ("vertices", "triangles", "vertex_normals", "vertex_colors", "triangle_uvs")}


def part(mesh):
    """The corners of the triangles. JSON has no NaN."""
    corners = numpy.asarray(mesh.triangles).reshape(-1)
    attributes = {"POSITION": numpy.asarray(mesh.vertices)[corners]}
    if mesh.has_vertex_normals():
        attributes["NORMAL"] = numpy.asarray(mesh.vertex_normals)[corners]
    if mesh.has_vertex_colors():
        attributes["COLOR_0"] = numpy.pad(numpy.asarray(mesh.vertex_colors)[corners], ((0, 0), (0, 1)), constant_values=1)
    if mesh.has_triangle_uvs():
        attributes["TEXCOORD_0"] = numpy.asarray(mesh.triangle_uvs)
    attributes = {name: numpy.nan_to_num(values, nan=9999, posinf=9999, neginf=-9999).tolist() for name, values in attributes.items()}
    return {"mode": 4, "index": None, "count": len(corners), "attributes": attributes}


def read(path):
    """The model, and what Open3D says: a model without meshes is no sign of a failure."""
    with tempfile.TemporaryFile() as file:
        own = os.dup(1)
        os.dup2(file.fileno(), 1)
        try:
            model = open3d.io.read_triangle_model(path)
        finally:
            os.dup2(own, 1)
            os.close(own)
        file.seek(0)
        return model, file.read().decode(errors="replace")


def answer(path):
    model, said = read(path)
    if "Unable to load" in said:
        return {"refused": "unable to load"}
    print("\nLOADED", flush=True)
    try:
        images = [image for material in model.materials for _, image in held(material)]
        albedo = [material.albedo_img for material in model.materials if material.albedo_img]
        dump = {"meshes": [[it.mesh_name, it.material_idx, lists(it.mesh)] for it in model.meshes], "materials": [values(it) for it in model.materials]}
        return {"dump": json.dumps(dump, sort_keys=True),
                "facts": {"parts": [part(it.mesh) for it in model.meshes if it.mesh.has_triangles()], "images": sorted(json.dumps(digest(it)) for it in images),
                          "pixels": [samples(it) for it in albedo]}}
    except Exception as error:
        return {"refused": f"harness: {error!r}"}


for line in sys.stdin:
    print(f"\nANSWER {line.strip()}\t" + json.dumps(answer(line.strip())), flush=True)

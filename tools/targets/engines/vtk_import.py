# SPDX-License-Identifier: Apache-2.0
"""Imports the assets whose paths come line by line, and prints the actors, cameras and lights that VTK makes."""
import hashlib
import json
import sys

import vtk


def rounded(array):
    values = [round(x, 4) + 0.0 for i in range(array.GetNumberOfTuples()) for x in array.GetTuple(i)]
    return hashlib.sha256(json.dumps(values).encode()).hexdigest()[:12]


def arrays(data):
    return sorted([str(data.GetArrayName(i)), data.GetArray(i).GetNumberOfComponents(), rounded(data.GetArray(i))]
                  for i in range(data.GetNumberOfArrays()) if data.GetArray(i))


def texture(it):
    if not it:
        return None
    image = it.GetInput()
    scalars = image.GetPointData().GetScalars() if image else None
    return [image.GetDimensions() if image else None, rounded(scalars) if scalars else None, it.GetWrap() if hasattr(it, "GetWrap") else it.GetRepeat(),
            it.GetInterpolate(), it.GetMipmap(), it.GetUseSRGBColorSpace()]


def getters(thing, names):
    out = {}
    for name in names:
        get = getattr(thing, f"Get{name}", None)
        if get:
            value = get()
            out[name] = [round(x, 4) for x in value] if isinstance(value, tuple) else round(value, 4) if isinstance(value, float) else value
    return out


SURFACE = ["Color", "Opacity", "Metallic", "Roughness", "Interpolation", "BackfaceCulling", "FrontfaceCulling", "EmissiveFactor", "NormalScale",
           "OcclusionStrength", "BaseIOR", "CoatStrength", "CoatRoughness", "CoatColor", "Anisotropy", "AnisotropyRotation", "EdgeTint", "Lighting", "Representation", "PointSize", "LineWidth"]
CAMERA = ["Position", "FocalPoint", "ViewUp", "ViewAngle", "ParallelProjection", "ParallelScale", "ClippingRange"]
LIGHT = ["Position", "FocalPoint", "Color", "DiffuseColor", "Intensity", "ConeAngle", "Positional", "Exponent", "AttenuationValues", "LightType"]


def elements(matrix):
    return [round(matrix.GetElement(r, c), 4) for r in range(4) for c in range(4)]


def samples(it):
    """The colors in the middle of each quarter, in fifths: the same for lossy images, and for other sizes."""
    image = it.GetInput()
    width, height, _ = image.GetDimensions()
    scalars = image.GetPointData().GetScalars()
    scale = {3: 255.0, 5: 65535.0}.get(scalars.GetDataType(), 1.0)
    return [[round(5 * v / scale) for v in scalars.GetTuple((height * y // 4) * width + width * x // 4)] for y in (1, 3) for x in (1, 3)]


def textures(surface):
    names = ("albedoTex", "materialTex", "normalTex", "emissiveTex", "coatNormalTex", "anisotropyTex")
    return {name: texture(surface.GetTexture(name)) for name in names if surface.GetTexture(name)}


def actor_of(actor):
    data = actor.GetMapper().GetInput()
    surface = actor.GetProperty()
    mapper = actor.GetMapper()
    return {
        "matrix": elements(actor.GetMatrix()),
        "user": elements(actor.GetUserMatrix()) if actor.GetUserMatrix() else None,
        "points": rounded(data.GetPoints().GetData()) if data.GetPoints() else None,
        "cells": [rounded(cells.GetData()) for cells in (data.GetVerts(), data.GetLines(), data.GetStrips(), data.GetPolys())],
        "arrays": arrays(data.GetPointData()),
        "surface": getters(surface, SURFACE),
        "textures": textures(surface),
        "texture": texture(actor.GetTexture()),
        "opaque": [actor.GetForceOpaque(), actor.GetForceTranslucent()],
        "scalars": mapper.GetScalarVisibility(),
        "shader": actor.GetShaderProperty().GetNumberOfShaderReplacements() if actor.GetShaderProperty() else 0,
    }


def part(actor):
    data = actor.GetMapper().GetInput()
    if not data.GetPoints():
        return None
    matrix = actor.GetMatrix()
    points = [list(matrix.MultiplyPoint((*data.GetPoint(i), 1)))[:3] for i in range(data.GetNumberOfPoints())]
    attributes = {"POSITION": points}
    point_data = data.GetPointData()
    for name, array in (("NORMAL", point_data.GetNormals()), ("TEXCOORD_0", point_data.GetTCoords()), ("COLOR_0", point_data.GetArray("COLOR_0"))):
        if array:
            scale = {3: 255.0, 5: 65535.0}.get(array.GetDataType(), 1.0) if name == "COLOR_0" else 1.0
            values = [[x / scale for x in array.GetTuple(i)] for i in range(array.GetNumberOfTuples())]
            attributes[name] = [(v + [1])[:4] for v in values] if name == "COLOR_0" else values
    out = []
    for mode, cells, split in ((0, data.GetVerts(), 1), (1, data.GetLines(), 2), (5, data.GetStrips(), 0), (4, data.GetPolys(), 3)):
        ids = vtk.vtkIdList()
        cells.InitTraversal()
        while cells.GetNextCell(ids):
            order = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
            if mode == 1 and len(order) > 2:
                out.append({"mode": 3, "index": order, "attributes": attributes})
            elif mode == 5 or len(order) > 3:
                out.append({"mode": 5 if mode == 5 else 6 if mode == 4 else mode, "index": order, "attributes": attributes})
            elif out and out[-1]["mode"] == mode:
                out[-1]["index"] += order
            else:
                out.append({"mode": mode, "index": order, "attributes": attributes})
    return out


def moved(animations, count):
    """The numbers of the actors that animations move: every second frame holds their matrices."""
    return [i for i in range(count) if any(matrices[i] != frames[0][i] for _, frames in animations for matrices in frames[::2])]


def has_meshes(path):
    with open(path, "rb") as file:
        return b'"meshes"' in file.read()


def answer(path):
    importer = vtk.vtkGLTFImporter()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    renderer = vtk.vtkRenderer()
    window.AddRenderer(renderer)
    importer.SetFileName(path)
    importer.SetRenderWindow(window)
    importer.Update()
    actors = list(renderer.GetActors())
    if not actors:  # other questions of the importer would end the program
        return {"refused": "no actors" if has_meshes(path) else "harness: nothing to load"}
    print("\nLOADED", flush=True)
    lights = list(renderer.GetLights())
    cameras = []
    for i in range(importer.GetNumberOfCameras()):
        importer.SetCamera(i)
        cameras.append(getters(renderer.GetActiveCamera(), CAMERA))
    animations = []
    for i in range(importer.GetNumberOfAnimations()):
        importer.EnableAnimation(i)
        frames = []
        for time in (0, 0.25, 0.5, 0.75, 1):
            importer.UpdateTimeStep(time)
            frames.append([elements(actor.GetMatrix()) for actor in actors])
            frames.append([rounded(actor.GetMapper().GetInput().GetPoints().GetData()) for actor in actors])
        animations.append([importer.GetAnimationName(i), frames])
        importer.DisableAnimation(i)
    try:
        dump = {"actors": [actor_of(it) for it in actors], "lights": [getters(it, LIGHT) for it in lights], "cameras": cameras, "animations": animations}
        return {"dump": json.dumps(dump, sort_keys=True),
                "facts": {"parts": [p for it in actors for p in (part(it) or [])], "tracks": [it[1] for it in animations],
                          "animations": [it[0] for it in animations], "lights": len(lights),
                          "moved": moved(animations, len(actors)),
                          "images": sorted(json.dumps(t[:2]) for it in actors for t in textures(it.GetProperty()).values()),
                          "pixels": [samples(it.GetProperty().GetTexture("albedoTex")) for it in actors if it.GetProperty().GetTexture("albedoTex")]}}
    except Exception as error:
        return {"refused": f"harness: {error!r}"}


vtk.vtkObject.GlobalWarningDisplayOff()
for line in sys.stdin:
    print(f"\nANSWER {line.strip()}\t" + json.dumps(answer(line.strip())), flush=True)

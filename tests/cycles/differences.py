# SPDX-License-Identifier: Apache-2.0
"""Scenes that show known differences of Blender's importer and of Cycles, as imported."""
from comparison import (DARK, bumps, floor, known_difference, matte, row, sheet, shelf, stage,
                        with_texture)
from pictures import png
from scene import lambert, material
from vectors import facing


@known_difference("matte balls, specularFactor 0", "the importer reads no specularFactor, and "
                  "Principled has the diffuse BRDF of Disney", grid=(3, 5))
def imported_diffuse():
    return row(stage(height=0.3, distance=4), [lambert((shade,) * 3) for shade in (0.2, 0.5, 0.8)])


@known_difference("metal of roughness 0.8 and 1", "Cycles masks and shadows microfacets "
                  "independently of each other, the specification correlates both by height",
                  grid=(3, 5))
def rough_metal():
    return row(stage(height=0.3, distance=4), [material((0.95, 0.7, 0.3), 1, rough)
                                               for rough in (0.8, 0.9, 1)])


@known_difference("colored plastic, with the default shader of gltfx", "Principled has the diffuse "
                  "BRDF of Disney, brighter at the edges of rough surfaces, and its specular layer "
                  "takes nothing from that", grid=(3, 5), shader="conserving")
def imported_plastic():
    return row(stage(height=0.3, distance=4), [material((0.2, 0.5, 0.7), 0, rough)
                                               for rough in (0.1, 0.5, 0.9)])


@known_difference("KHR_materials_ior alone", "the importer gives it to refraction alone; with "
                  "KHR_materials_specular, to reflection, too", grid=(3, 5))
def imported_ior():
    return row(stage(height=0.3, distance=4), [material(DARK, 0, 0.3, extensions={
        "ior": {"ior": ior}}) for ior in (1.2, 1.8, 2.4)])


@known_difference("KHR_materials_clearcoat", "the coat of Principled is a quarter as strong and "
                  "has the distribution GTR1", grid=(3, 5))
def imported_clearcoat():
    return row(stage(height=0.3, distance=4), [material(DARK, 0, 1, extensions={"clearcoat": {
        "clearcoatFactor": 1, "clearcoatRoughnessFactor": rough}}) for rough in (0, 0.2, 0.4)])


@known_difference("KHR_materials_sheen", "the importer adds the shader Velvet", grid=(3, 5))
def imported_sheen():
    return row(stage(height=0.3, distance=4), [material((0.3, 0.1, 0.1), 0, 1, extensions={
        "sheen": {"sheenColorFactor": [0.8, 0.6, 0.6], "sheenRoughnessFactor": rough}})
        for rough in (0.3, 0.6, 0.9)])


@known_difference("KHR_materials_anisotropy and iridescence", "not imported", grid=(2, 2))
def imported_layers():
    return row(stage(height=0.3, distance=3), [material((0.6, 0.6, 0.6), 1, 0.4, extensions=more)
                                               for more in (
        {"anisotropy": {"anisotropyStrength": 0.9}},
        {"iridescence": {"iridescenceFactor": 1, "iridescenceThicknessMaximum": 300}})])


@known_difference("alphaMode MASK of a texture between 0 and 1", "the importer blends, and does "
                  "not compare with alphaCutoff")
def imported_mask():
    scene = stage()
    floor(scene)
    index = scene.texture(png([[(230, 120, 40, 4 * x) for x in range(64)]] * 4))
    sheet(scene, 0.7, with_texture(matte((1, 1, 1), alphaMode="MASK", doubleSided=True),
                                   "baseColorTexture", index), (0, 0.1, 0))
    return scene


@known_difference("the back of a single-sided sheet", "Cycles shows both sides")
def imported_back():
    scene = stage()
    floor(scene)
    sheet(scene, 0.7, matte((0.9, 0.3, 0.2)), (0, 0.1, 0), 180)
    return scene


@known_difference("normal map of a matte sheet", "Cycles darkens diffuse light of mapped normals "
                  "(Chiang, Li and Burley, Taming the Shadow Terminator, 2019)")
def mapped_diffuse():
    scene = stage(height=0.5, distance=3.2)
    sheet(scene, 0.8, matte((0.7, 0.7, 0.7), doubleSided=True,
                            normalTexture={"index": scene.texture(bumps())}))
    return scene


@known_difference("KHR_materials_transmission without a volume", "Principled refracts as a solid")
def imported_thin_wall():
    return row(shelf(), [material((1, 1, 1), 0, rough, extensions={
        "transmission": {"transmissionFactor": 1}}) for rough in (0, 0.4)], 0.35)


@known_difference("KHR_materials_volume that absorbs", "the importer absorbs by (1 - color) / "
                  "distance, and not by -ln(color) / distance", grid=(3, 5))
def imported_absorption():
    return row(shelf(), [material((1, 1, 1), 0, 0, extensions={
        "transmission": {"transmissionFactor": 1}, "ior": {"ior": 1.2}, "volume": {
            "thicknessFactor": 1, "attenuationDistance": 0.3, "attenuationColor": [red, 0.8, 0.9]}})
        for red in (0.1, 0.3, 0.5)], 0.35)


@known_difference("a spot light", "Cycles dims it by the cosine of the angle to its axis, and "
                  "fades its edge by another curve", sky="dim")
def spot_light():
    scene = stage(height=2.5)
    floor(scene)
    scene.light("spot", place={"translation": [0, 1.4, 0], "rotation": facing((0, 1, 0.01))},
                intensity=3, spot={"innerConeAngle": 0.5, "outerConeAngle": 0.7})
    return scene


@known_difference("a point light that has a range", "not imported")
def light_range():
    scene = stage(height=2.5)
    floor(scene)
    scene.light("point", place={"translation": [0, 0.6, 0]}, intensity=2, range=1.3)
    return scene

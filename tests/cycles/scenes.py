# SPDX-License-Identifier: Apache-2.0
"""Scenes of which both renderers are to draw the same picture."""
import math

from comparison import (DARK, FLAT, GREY, bumps, checks, comparison, floor, matte, row, sheet,
                        shelf, stage, with_texture)
from brdf import dielectric_fresnel, iridescent_fresnel, visibility
from pictures import png
from scene import box, lamp, material, quad, sphere
from vectors import dot, normalize, plus, turn

FRESNEL = ("Cycles has Fresnel's formula, gltfx Schlick's, which is up to a fifth lower around 50 "
           "degrees")


MASKING = ("Cycles follows the light from facet to facet, masked independently of the height; gltfx "
           "scales what is reflected once")


# Surfaces.

@comparison("diffuse light, a shadow of the environment")
def diffuse():
    scene = stage()
    floor(scene)
    scene.draw(sphere(0.6, 64), matte((0.8, 0.3, 0.2)))
    return scene


@comparison("metal of roughness 0 to 0.6", grid=(5, 9))
def metal():
    return row(stage(height=0.3), [material((0.95, 0.7, 0.3), 1, rough)
                                   for rough in (0, 0.15, 0.3, 0.45, 0.6)])


def rough_metals(color):
    return row(stage(height=0.3), [material(color, 1, rough, extras={"nodes": "many bounces"})
                                   for rough in (0.2, 0.4, 0.6, 0.8, 1)])


@comparison("white metal of roughness 0.2 to 1 with the default shader, which like Cycles' "
            "multiscatter GGX loses no light", grid=(5, 9), shader="conserving", tolerance=0.05,
            because=MASKING)
def rough_white_metal():
    return rough_metals((1, 1, 1))


@comparison("the same of copper, whose color deepens", grid=(5, 9), shader="conserving",
            tolerance=0.08, because=MASKING)
def rough_copper():
    return rough_metals((0.95, 0.64, 0.54))


def film_colors(ior, base_f0, thickness):
    """Of a thin film by cosine, red, green and blue in turn."""
    return [min(value, 1) for i in range(32)
            for value in iridescent_fresnel(ior, base_f0, thickness, max(i / 31, 1e-4))]


def films(base, metallic, f0):
    return row(stage(height=0.3), [material(base, metallic, 0, extras={
        "nodes": "film", "film": film_colors(ior, f0, thickness)}, extensions={"iridescence": {
            "iridescenceFactor": 1, "iridescenceIor": ior,
            "iridescenceThicknessMaximum": thickness}})
        for ior, thickness in ((1.3, 200), (1.3, 400), (1.5, 300), (1.8, 200), (1.8, 300))])


@comparison("thin films on a mirror of gold", grid=(5, 9), shader="conserving")
def films_on_metal():
    gold = (1, 0.78, 0.34)
    return films(gold, 1, gold)


@comparison("thin films on white plastic, which loses no light", grid=(5, 9), shader="conserving")
def films_on_plastic():
    return films((0.9, 0.9, 0.9), 0, 0.04)


@comparison("the specular layer of dark plastic of roughness 0 to 0.8", sky="dim", grid=(5, 9),
            tolerance=0.05, because=FRESNEL)
def gloss():
    scene = stage(height=0.3)
    scene.sun((0.3, 0.5, 1), 2.5)
    return row(scene, [material(DARK, 0, rough) for rough in (0, 0.2, 0.4, 0.6, 0.8)])


def left_over(roughness, n_v, points=610, turns=377):
    """What the layer of a dielectric leaves of an even light, summed over visible normals."""
    alpha = roughness**2
    v = (math.sqrt(1 - n_v**2), 0.0, n_v)
    stretched = normalize((alpha * v[0], 0.0, v[2]))
    reflected = 0
    for i in range(points):
        z = (1 - (i + 0.5) / points) * (1 + stretched[2]) - stretched[2]
        angle = 2 * math.pi * (i * turns % points + 0.5) / points
        radius = math.sqrt(max(0.0, 1 - z * z))
        cap = plus((radius * math.cos(angle), radius * math.sin(angle), z), stretched)
        h = normalize((alpha * cap[0], alpha * cap[1], max(cap[2], 1e-12)))
        v_h = dot(v, h)
        n_l = 2 * v_h * h[2] - n_v
        if n_l > 0:
            seen = 2 * n_l * (n_v + math.sqrt(alpha**2 + (1 - alpha**2) * n_v**2))
            reflected += dielectric_fresnel(v_h)[0] * visibility(alpha, n_l, n_v) * seen / points
    return 1 - reflected


def colored_plastic(**more):
    """`more`: for each roughness, further properties of the material."""
    return row(stage(height=0.3), [
        material((0.2, 0.5, 0.7), 0, rough, extras={
            "nodes": "plastic", **{name: of(rough) for name, of in more.items()}})
        for rough in (0.1, 0.3, 0.5, 0.7, 0.9)])


@comparison("colored plastic of roughness 0.1 to 0.9", grid=(5, 9), tolerance=0.03,
            because="the base in Cycles gets what the layer leaves over for the angle of the view")
def plastic():
    return colored_plastic()


@comparison("the same with the default shader of gltfx", grid=(5, 9), shader="conserving",
            tolerance=0.03, because="the base in gltfx is (1 - E(V)) (1 - E(L)) / (1 - Emean) of "
            "Kulla and Conty (2017); a material of Cycles cannot depend on the light, and has but "
            "1 - E(V)")
def plastic_conserving():
    return colored_plastic(rest=lambda rough: [left_over(rough, max(i / 31, 1e-3))
                                               for i in range(32)])


@comparison("metallicFactor and roughnessFactor by a texture")
def metallic_roughness_texture():
    scene = stage()
    floor(scene)
    index = scene.texture(png([[(0, 40 + 12 * (x // 8), 255, 255) for x in range(64)]
                               for _ in range(8)]), wrapS=33071, wrapT=33071)
    ball = sphere(0.6, 48)
    uv = [(j / 96, i / 48) for i in range(49) for j in range(97)]
    scene.draw(ball.having(TEXCOORD_0=uv), with_texture(
        material((0.9, 0.6, 0.5), 1, 1), "metallicRoughnessTexture", index))
    return scene


@comparison("alphaMode MASK, and its shadow")
def alpha_mask():
    scene = stage()
    floor(scene)
    index = scene.texture(checks(4, (230, 120, 40, 255), (0, 0, 0, 0)), magFilter=9728,
                          minFilter=9728)
    sheet(scene, 0.7, with_texture(matte((1, 1, 1), alphaMode="MASK", doubleSided=True),
                                   "baseColorTexture", index), (0, 0.1, 0), 25)
    return scene


@comparison("alphaMode BLEND, two sheets one behind the other")
def alpha_blend():
    scene = stage()
    floor(scene)
    for x, z, color, alpha in ((-0.25, 0.3, (0.9, 0.2, 0.1), 0.5),
                               (0.25, -0.2, (0.1, 0.4, 0.9), 0.8)):
        sheet(scene, 0.5, matte(color, alpha=alpha, alphaMode="BLEND", doubleSided=True),
              (x, 0.1, z), 10)
    return scene


@comparison("normal map of metal")
def normal_map():
    scene = stage(height=0.5, distance=3.2)
    sheet(scene, 0.8, material((0.7, 0.7, 0.7), 1, 0.5, doubleSided=True,
                               normalTexture={"index": scene.texture(bumps()), "scale": 0.8}))
    return scene


@comparison("normal map of smooth metals with the default shader: both bend up what the map "
            "reflects below the surface", shader="conserving", grid=(6, 6), tolerance=0.04,
            because="each bends the normal by a rule of its own")
def normal_map_of_smooth_metals():
    scene = stage(height=2.2, distance=3.2)
    index = scene.texture(bumps())
    for x, rough in ((-0.85, 0.1), (0, 0.2), (0.85, 0.4)):
        sheet(scene, 0.4, material((0.7, 0.6, 0.5), 1, rough, doubleSided=True,
                                   normalTexture={"index": index, "scale": 1.0}), (x, 0, 0), 50)
    return scene


@comparison("vertex colors")
def vertex_colors():
    scene = stage()
    floor(scene)
    colored = [(0.5 + 0.5 * x, 0.5 + 0.5 * y, 0.5 + 0.5 * z) for x, y, z in
               sphere(1, 48).attributes["POSITION"]]
    scene.draw(sphere(0.6, 48).having(COLOR_0=colored), matte((1, 1, 1)))
    return scene


@comparison("KHR_texture_transform, wrapping and a second set of coordinates")
def texture_transform():
    scene = stage(height=0.5, distance=3.2)
    rows = [[(40 + 4 * x, 200 - 3 * y, 60 + 40 * ((x // 8 + y // 8) % 2)) for x in range(32)]
            for y in range(32)]
    moved = {"KHR_texture_transform": {"offset": [0.2, 0.4], "rotation": 0.5, "scale": [1.5, 2.5]}}
    for x, wrap, more in ((-0.45, 10497, {"extensions": moved}), (0.45, 33648, {"texCoord": 1})):
        shape = quad(0.42, 0.7)
        shape = shape.having(TEXCOORD_1=[(2.2 * u - 0.6, 1.7 * v - 0.4) for u, v in
                                         shape.attributes["TEXCOORD_0"]])
        index = scene.texture(png(rows), wrapS=wrap, wrapT=wrap)
        scene.draw(shape, with_texture(matte((1, 1, 1), doubleSided=True), "baseColorTexture",
                                       index, **more), translation=[x, 0, 0])
    return scene


@comparison("KHR_materials_ior and specularColorFactor", grid=(5, 9), tolerance=0.05,
            because=FRESNEL)
def ior():
    def dark(ior, color=1.0):
        return material(DARK, 0, 0.3, extensions={"ior": {"ior": ior}, "specular": {
            "specularColorFactor": [color] * 3}})
    return row(stage(height=0.3), [dark(1.2), dark(1.5), dark(2), dark(1.5, 0.5), dark(1.8, 0.6)])


@comparison("KHR_materials_clearcoat over metal", grid=(3, 5), tolerance=0.04, because=FRESNEL)
def clearcoat():
    def coat(factor, rough):
        return material((0.6, 0.1, 0.1), 1, 0.6, extras={"nodes": "coat"}, extensions={
            "clearcoat": {"clearcoatFactor": factor, "clearcoatRoughnessFactor": rough}})
    return row(stage(height=0.3, distance=4), [coat(1, 0.1), coat(0.5, 0.1), coat(1, 0.4)])


# Light that passes through.

@comparison("KHR_materials_transmission: a smooth thin wall")
def thin_glass():
    scene = shelf()
    sheet(scene, 0.6, material((0.9, 0.5, 0.4), 0, 0, extras={"nodes": "thin"}, doubleSided=True,
                               extensions={"transmission": {"transmissionFactor": 1}}),
          (0, 0.1, 0), 30)
    return scene


def glass(ior, rough, **more):
    return material((1, 1, 1), 0, rough, extensions={
        "transmission": {"transmissionFactor": 1}, "ior": {"ior": ior},
        "volume": {"thicknessFactor": 1, **more}}, extras={"nodes": "volume"})


@comparison("KHR_materials_volume and ior: smooth balls", grid=(3, 5))
def glass_balls():
    return row(shelf(), [glass(1.1, 0), glass(1.5, 0, attenuationDistance=0.5,
                                              attenuationColor=[0.3, 0.9, 0.5]), glass(2, 0)], 0.35)


@comparison("KHR_materials_volume: rough balls", grid=(3, 5))
def rough_glass():
    return row(shelf(), [glass(1.5, 0.2), glass(1.5, 0.4), glass(1.5, 0.6)], 0.35)


# Lights.

@comparison("an emissive panel above a floor, KHR_materials_emissive_strength")
def emissive():
    scene = stage(height=2.5)
    floor(scene)
    scene.draw(quad(0.5, 0.3), lamp((6, 4.8, 3), doubleSided=True), rotation=turn((1, 0, 0), 60),
               translation=[0, 0.9, -0.3])
    scene.draw(sphere(0.3, 32), matte((0.7, 0.7, 0.7)), translation=[0.2, -0.3, 0.4])
    return scene


@comparison("KHR_lights_punctual: two points", sky="dim")
def lamps():
    scene = stage(height=2.5)
    floor(scene)
    scene.draw(sphere(0.3, 48), matte((0.7, 0.7, 0.7)), translation=[0, -0.3, 0])
    scene.light("point", place={"translation": [-0.9, 0.6, 0.5]}, intensity=0.6,
                color=[1, 0.6, 0.3])
    scene.light("point", place={"translation": [1.2, 1.4, 0.6]}, intensity=2,
                color=[0.3, 0.7, 1])
    return scene


@comparison("KHR_lights_punctual: directional", sky="dim")
def sun():
    scene = stage()
    floor(scene)
    scene.draw(sphere(0.5, 64), matte((0.7, 0.7, 0.7)))
    scene.draw(box(0.2, 0.4, 0.2), material((0.9, 0.8, 0.6), 1, 0.4), translation=[0.8, -0.2, 0.5])
    scene.sun((0.6, 0.7, 0.4), 2.5)
    return scene


# Light between surfaces, and places.

def walls(scene, materials, half=0.9):
    """A box that is open towards the camera: left, right, back, floor, ceiling."""
    for made_of, at, rotation in zip(materials, (
            [-half, 0, 0], [half, 0, 0], [0, 0, -half], [0, -half, 0], [0, half, 0]), (
            turn((0, 1, 0), 90), turn((0, 1, 0), -90), turn((0, 1, 0), 0), FLAT,
            turn((1, 0, 0), 90))):
        made_of["doubleSided"] = True
        scene.draw(quad(half), made_of, rotation=rotation, translation=at)


@comparison("colors that walls give each other")
def color_bleeding():
    scene = stage(height=0.1, distance=5)
    white = (0.8, 0.8, 0.8)
    walls(scene, [matte((0.8, 0.1, 0.1)), matte((0.1, 0.7, 0.1)), matte(white), matte(white),
                  matte(white)])
    scene.draw(box(0.25, 0.5, 0.25), matte(white), translation=[-0.3, -0.4, -0.2],
               rotation=turn((0, 1, 0), 20))
    scene.draw(sphere(0.3, 48), matte(white), translation=[0.4, -0.6, 0.2])
    return scene


@comparison("metal that mirrors metal")
def metal_box():
    scene = stage(height=0.1, distance=5)
    walls(scene, [material((0.9, 0.75, 0.7), 1, 0.2), material((0.75, 0.85, 0.9), 1, 0.3),
                  material((0.9, 0.9, 0.9), 1, 0.1), material((0.85, 0.8, 0.7), 1, 0.3),
                  material((0.9, 0.9, 0.9), 1, 0.2)])
    scene.draw(sphere(0.4, 48), material((0.9, 0.9, 0.9), 1, 0.0), translation=[0, -0.3, 0])
    return scene


@comparison("nodes: instances, uneven and negative scale, a matrix")
def transforms():
    scene = stage()
    floor(scene)
    ball = scene.mesh(sphere(0.3, 32), matte((0.8, 0.5, 0.2)))
    outer = scene.node(rotation=turn((0, 0, 1), 20), scale=[1.2, 0.8, 1])
    for x, scale in ((-0.9, [1, 1, 1]), (-0.2, [0.5, 1.5, 1]), (0.5, [-1, 0.7, 1])):
        scene.node(outer, mesh=ball, translation=[x, 0, 0], scale=scale,
                   rotation=turn((1, 0, 0), 30))
    # Normals that are not those of triangles, mirrored.
    wedge = quad(0.4).having(NORMAL=[normalize((0.3, 0, 1))] * 2 + [normalize((-0.3, 0.2, 1))] * 2)
    scene.draw(wedge, matte((0.3, 0.6, 0.8), doubleSided=True),
               matrix=[-0.8, 0.2, 0, 0, 0.25, 1, 0, 0, 0, 0, 0.7, 0, 1.1, 0.2, 0.3, 1])
    return scene

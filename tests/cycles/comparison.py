# SPDX-License-Identifier: Apache-2.0
"""Scenes for both renderers, tolerances of their pictures, and parts of scenes."""
import math

from pictures import png
from scene import Scene, lambert, perspective, quad, sphere
from vectors import facing, normalize, turn

TOLERANCE = 0.02
FLAT = turn((1, 0, 0), -90)  # from z = 0 to a floor
DARK = (0.02, 0.02, 0.02)
GREY = (0.5, 0.5, 0.5)


class Comparison:
    """
    name, what  of the scene, and what of gltfx and Cycles it compares
    scene       Scene, seen through its first camera
    grid        columns and rows of the regions whose means are compared
    tolerance   of regions: TOLERANCE, or more with `because`, the difference of the renderers that
                it admits. That of pixels is always TOLERANCE
    sky         name of the environment
    shader      of gltfx; where both give the same, that of the specification
    difference  which known difference of Blender's importer or of Cycles the scene shows: it must
                not agree
    """

    def __init__(self, name, what, scene, *, grid=(6, 6), tolerance=TOLERANCE, because="",
                 sky="bright", shader="spec", samples=512, difference=""):
        assert bool(because) == (tolerance > TOLERANCE), name
        self.name, self.what, self.scene, self.grid = name, what, scene, grid
        self.tolerance, self.because, self.difference = tolerance, because, difference
        self.sky, self.shader, self.samples = sky, shader, samples


MAKERS = []


def comparison(what, **more):
    """For functions that give a Scene; their names are those of the comparisons."""
    def add(function):
        name = function.__name__.replace("_", "-")
        MAKERS.append(lambda: Comparison(name, what, function(), **more))
        return function
    return add


def known_difference(what, because, **more):
    """As imported, with fewer samples."""
    return comparison(what, difference=because, samples=128, **more)


def all_comparisons():
    return [make() for make in MAKERS]


# Parts of scenes. `extras.nodes` of a material names an adaptation of draw_in_blender.py.

def matte(color=GREY, **more):
    return lambert(color, extras={"nodes": "lambert"}, **more)


def stage(distance=6.0, height=1.5, yfov=0.6):
    """A camera in front of the origin, that looks at it from above."""
    scene = Scene()
    toward = normalize((0, height, distance))
    scene.camera(perspective(yfov, aspectRatio=1), rotation=facing(toward),
                 translation=[0, height, distance])
    return scene


def floor(scene, y=-0.6, half=6, made_of=None):
    scene.draw(quad(half), made_of or matte(GREY, doubleSided=True), rotation=FLAT,
               translation=[0, y, 0])


def row(scene, materials, radius=0.34, bands=48):
    """Balls side by side, one for each material."""
    ball = sphere(radius, bands)
    for i, made_of in enumerate(materials):
        scene.draw(ball, made_of, translation=[(i - (len(materials) - 1) / 2) * 0.72, 0, 0])
    return scene


def sheet(scene, half, made_of, at=(0, 0, 0), degrees=0.0):
    scene.draw(quad(half), made_of, rotation=turn((0, 1, 0), degrees), translation=list(at))


def checks(cells, one, other, size=8):
    """PNG of checks, each `size` texels wide."""
    return png([[one if (x // size + y // size) % 2 else other for x in range(cells * size)]
                for y in range(cells * size)])


def with_texture(made_of, slot, index, **more):
    made_of["pbrMetallicRoughness"][slot] = {"index": index, **more}
    return made_of


def bumps():
    """PNG of a normal map: waves along both axes."""
    def texel(x, y):
        n = normalize((0.5 * math.cos(x * math.pi / 8), 0.5 * math.sin(y * math.pi / 8), 1))
        return tuple(round(127.5 + 127.5 * c) for c in n)
    return png([[texel(x, y) for x in range(64)] for y in range(64)])


def shelf():
    """Objects that are visible through others."""
    scene = stage()
    floor(scene)
    index = scene.texture(checks(6, (230, 230, 230), (40, 60, 90)), magFilter=9728, minFilter=9728)
    sheet(scene, 1.6, with_texture(matte((1, 1, 1), doubleSided=True), "baseColorTexture", index),
          (0, 0.4, -1.5))
    return scene

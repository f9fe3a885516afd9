# SPDX-License-Identifier: Apache-2.0
"""Where things are in a picture: cameras, nodes, animations, deformation; and its exposure."""
import math

from case import Case, centroid, group, pixels
from cases_lights import COLOR, lambert_under, wall
from scene import UINT, Scene, Shape, lambert, lamp, material, orthographic, perspective, quad
from vectors import direction, facing, plus, rotated, times, turn


# Where the light of a small square is in a picture. Filters are as wide to the left as to the
# right, so that the center of the light is where the point is projected.

# Squares are at least a pixel wide, so that some 1024 samples meet each: their mean deviates by
# 1 / sqrt(12 * 1024) of a pixel.
PLACES = 0.03


def projected(matrix_x, matrix_y, size):
    """Normalized device coordinates to columns and rows."""
    return (matrix_x + 1) / 2 * size[0], (1 - matrix_y) / 2 * size[1]


def marked(point, side, rotation=None):
    scene = Scene()
    scene.draw(quad(side), lamp((1, 1, 1), doubleSided=True), translation=list(point),
               **({"rotation": rotation} if rotation else {}))
    return scene


def place_case(name, source, scene, expected, size=(16, 16), options=()):
    return Case(f"camera: {name}", source, scene, expected, measure=centroid, samples=1024,
                size=size, near=PLACES, options=options)


@group
def cameras():
    source = "Projection Matrices (3.10.3)"
    for yfov, size, spot in ((0.6, (16, 16), (0.5, -0.4)), (1.4, (16, 16), (-2.2, 1.7)),
                             (0.6, (24, 12), (-1.2, 0.6)), (0.6, (12, 24), (0.25, 0.9))):
        scene = marked((*spot, -4), 2 * math.tan(yfov / 2) / 4 * 16 / size[1])
        scene.camera(perspective(yfov), scale=[2, 2, 2])
        cotangent = 1 / math.tan(yfov / 2)
        x, y = cotangent * spot[0] / 4 * size[1] / size[0], cotangent * spot[1] / 4
        yield place_case(f"perspective {yfov}, {size[0]} by {size[1]}", source, scene,
                         projected(x, y, size), size)
    for half, size, spot in ((1, (16, 16), (0.55, -0.7)), (3, (20, 10), (-3.3, 2))):
        scene = marked((*spot, -9), half / size[1])
        scene.camera(orthographic(half * size[0] / size[1], half))
        yield place_case(f"orthographic {half}, {size[0]} by {size[1]}", source, scene,
                         projected(spot[0] / half * size[1] / size[0], spot[1] / half, size), size)
    scene = marked((1.5, 0.5, 0), 0.2)
    around = turn((0, 0, 1), 30)
    scene.camera(orthographic(2, 2), translation=[1, 0, 4], rotation=around)
    x, y, _ = rotated((0.5, 0.5, 0), turn((0, 0, 1), -30))
    yield place_case("turned about its axis", "View Matrix (3.10.2)", scene,
                     projected(x / 2, y / 2, (16, 16)))
    scene = marked((0.7, 0.2, 0), 0.2)
    toward = direction(35, 70)
    scene.seen_from(toward, half=1.5)
    x, y, _ = rotated((0.7, 0.2, 0), [-c for c in facing(toward)[:3]] + [facing(toward)[3]])
    yield place_case("from aside", "View Matrix (3.10.2)", scene,
                     projected(x / 1.5, y / 1.5, (16, 16)))


def lerp(a, b, t):
    return tuple((1 - t) * x + t * y for x, y in zip(a, b))


def animated(values, path, interpolation, times_of=(0.0, 1.0, 3.0), point=(0, 0, 0)):
    scene = Scene()
    node = scene.node(**({"rotation": [0, 0, 0, 1]} if path == "rotation" else {}))
    scene.draw(quad(0.2), lamp(doubleSided=True), node, translation=list(point))
    scene.camera(orthographic(2, 2), translation=[0, 0, 5])
    scene.add("animations", {
        "channels": [{"sampler": 0, "target": {"node": node, "path": path}}],
        "samplers": [{"input": scene.accessor("SCALAR", list(times_of)),
                      "output": scene.accessor(f"VEC{len(values[0])}", values),
                      "interpolation": interpolation}]})
    return scene


def seen_at(point):
    return projected(point[0] / 2, point[1] / 2, (16, 16))


def hermite(v0, b0, v1, a1, t, duration):
    """Appendix C: value and out-tangent of one key, value and in-tangent of the next."""
    weights = (2 * t**3 - 3 * t**2 + 1, duration * (t**3 - 2 * t**2 + t), -2 * t**3 + 3 * t**2,
               duration * (t**3 - t**2))
    return plus(*(times(w, v) for w, v in zip(weights, (v0, b0, v1, a1))))


@group
def animations():
    keys = [(-1.0, -1.0, 0.0), (1.0, 0.5, 0.0), (0.2, 1.5, 0.0)]

    def case(name, scene, second, expected):
        return place_case(f"animation, {name}", "Appendix C", scene, seen_at(expected),
                          options=("--animation", "0", "--time", str(second)))
    for second, expected in ((0.25, lerp(keys[0], keys[1], 0.25)),
                             (2.0, lerp(keys[1], keys[2], 0.5)), (9, keys[2])):
        yield case(f"linear at {second}", animated(keys, "translation", "LINEAR"), second, expected)
    yield case("step", animated(keys, "translation", "STEP"), 2.9, keys[1])
    tangents = [(0.0, 0.0, 0.0), (0.5, -1.0, 0.0), (2.0, 1.0, 0.0), (-1.0, 0.3, 0.0)]
    cubic = [tangents[0], keys[0], tangents[1], tangents[2], keys[1], tangents[3], tangents[0],
             keys[2], tangents[0]]
    yield case("cubic in the first part", animated(cubic, "translation", "CUBICSPLINE"), 0.6,
               hermite(keys[0], tangents[1], keys[1], tangents[2], 0.6, 1))
    yield case("cubic in a part of two seconds", animated(cubic, "translation", "CUBICSPLINE"),
               1.5, hermite(keys[1], tangents[3], keys[2], tangents[0], 0.25, 2))
    turns = [tuple(turn((0, 0, 1), degrees)) for degrees in (0, 100, -40)]
    scene = animated(turns, "rotation", "LINEAR", point=(1.4, 0, 0))
    yield case("spherical", scene, 0.3, rotated((1.4, 0, 0), turn((0, 0, 1), 30)))
    # The other sign of a quaternion is the same rotation: the short way is taken.
    other = [turns[0], times(-1, turns[1]), turns[2]]
    scene = animated(other, "rotation", "LINEAR", point=(1.4, 0, 0))
    yield case("spherical, the short way", scene, 0.3, rotated((1.4, 0, 0), turn((0, 0, 1), 30)))


@group
def deformation():
    scene = Scene()
    base = quad(0.2)
    mesh = scene.mesh(base, lamp(doubleSided=True), weights=[0.5, 0.25])
    targets = [(1.6, 0.4, 0.0), (-0.8, 2.0, 0.0)]
    scene.json["meshes"][mesh]["primitives"][0]["targets"] = [
        {"POSITION": scene.accessor("VEC3", [target] * 4)} for target in targets]
    scene.node(mesh=mesh)
    scene.camera(orthographic(2, 2), translation=[0, 0, 5])
    yield place_case("morph targets add up", "Morph Targets (3.7.2.2)", scene,
                     seen_at(plus(times(0.5, targets[0]), times(0.25, targets[1]))))
    scene = Scene()
    hip = scene.node(translation=[1.2, 0, 0])
    joints = [hip, scene.node(hip, rotation=turn((0, 0, 1), 90), translation=[-1.6, 0, 0])]
    corners = base.attributes["POSITION"]
    moved = [plus(corner, (0.6, 0.0, 0.0)) for corner in corners]
    mesh = scene.mesh(Shape(base.triangles, POSITION=moved,
                            WEIGHTS_0=[(0.25, 0.75, 0.0, 0.0)] * 4), lamp(doubleSided=True))
    scene.json["meshes"][mesh]["primitives"][0]["attributes"]["JOINTS_0"] = scene.accessor(
        "VEC4", [(0, 1, 0, 0)] * 4, 5121)
    scene.add("skins", {"joints": joints})
    scene.node(mesh=mesh, skin=0)
    scene.camera(orthographic(2, 2), translation=[0, 0, 5])
    first, second = (0.6 + 1.2, 0.0, 0.0), (-0.4, 0.6, 0.0)
    yield place_case("two joints share a square", "Skins (3.7.3)", scene,
                     seen_at(lerp(first, second, 0.75)))


@group
def exposure():
    for stops in (-2, 1.5):
        scene = wall()
        scene.sun((0, 0, 1), 2)
        yield Case(f"exposure: {stops} stops", "ISO 2720: a stop is a factor of two", scene,
                   lambert_under(2 * 2**stops), options=("--exposure", str(stops)))
    scene = Scene()
    scene.draw(quad(), material(COLOR, extensions={"unlit": {}}))
    scene.seen_from(direction(40))
    scene.sun((0, 0, 1), 2)
    yield Case("unlit: its base color in any light", "KHR_materials_unlit, Definition", scene,
               COLOR)


@group
def every_pixel():
    """The light of a lamp on a wall, where the ray through the middle of each pixel meets it."""
    lamp_at, candela, size = (0.25, 0.5, 1.5), 0.7, 8

    def lit(x, y):
        squared = (x - lamp_at[0])**2 + (y - lamp_at[1])**2 + lamp_at[2]**2
        return lambert_under(candela * lamp_at[2] / squared**1.5)
    yfov, away = 0.7, 3.0
    for name, camera, half in (
            ("orthographic", orthographic(1, 1), 1.0),
            ("perspective", perspective(yfov), away * math.tan(yfov / 2))):
        scene = Scene()
        scene.draw(quad(2), lambert(COLOR))
        scene.light("point", place={"translation": list(lamp_at)}, intensity=candela)
        scene.camera(camera, translation=[0, 0, away])
        places = [(x, y) for y in range(1, size - 1) for x in range(1, size - 1)]
        expected = [c for x, y in places for c in lit(((x + 0.5) / size * 2 - 1) * half,
                                                      (1 - (y + 0.5) / size * 2) * half)]
        # A pixel is the mean around its middle: the second derivative of its light, which is at
        # most three times the light over the square of the height, times some width squared / 24.
        yield Case(f"pixels: a lamp on a wall, {name}", "E = I cos / d^2; Projection Matrices",
                   scene, expected, measure=pixels(*places), samples=256, size=(size, size),
                   near=0.002)


def shade(picture):
    """Colors over green, of a picture that is partly black."""
    mean = picture.mean()
    return mean[0] / mean[1], mean[2] / mean[1]


@group
def points_and_lines():
    base, emitted, tint = (0.8, 0.4, 0.2), (0.1, 0.2, 0.3), (0.5, 1.0, 0.75)
    seen = plus(tuple(b * t for b, t in zip(base, tint)), emitted)
    for name, mode, corners in (("points", 0, [(0.0, 0.0, 0.0), (0.5, 0.5, 0.0)]),
                                ("lines", 1, [(-0.7, 0.1, 0.0), (0.6, -0.3, 0.0)])):
        scene = Scene()
        scene.add("meshes", {"primitives": [{
            "mode": mode, "material": scene.add("materials", lambert(
                base, emissiveFactor=list(emitted))),
            "attributes": {"POSITION": scene.accessor("VEC3", corners),
                           "COLOR_0": scene.accessor("VEC3", [tint] * 2)}}]})
        scene.node(mesh=0)
        scene.camera(orthographic(1, 1), translation=[0, 0, 3])
        yield Case(f"{name}: without normals, base color plus emission",
                   "Point and Line Materials (3.9.7)", scene,
                   (seen[0] / seen[1], seen[2] / seen[1]), measure=shade, samples=64,
                   size=(16, 16))


@group
def placed_by_extensions():
    scene = Scene()
    scene.json["meshes"] = []
    mesh = scene.mesh(quad(0.2), lamp(doubleSided=True))
    shift, around = (0.5, -0.25, 0.0), turn((0, 0, 1), 90)
    scene.node(mesh=mesh, translation=[0.25, 0.5, 0], extensions={"EXT_mesh_gpu_instancing": {
        "attributes": {"TRANSLATION": scene.accessor("VEC3", [shift, (-1.0, 1.0, 0.0)]),
                       "SCALE": scene.accessor("VEC3", [(1.0, 1.0, 1.0)] * 2),
                       "ROTATION": scene.accessor("VEC4", [tuple(around)] * 2)}}})
    scene.camera(orthographic(2, 2), translation=[0, 0, 5])
    yield place_case("instances, two of them", "EXT_mesh_gpu_instancing", scene,
                     seen_at((0.25 + (0.5 - 1) / 2, 0.5 + (-0.25 + 1) / 2, 0)))
    scene = Scene()
    for x, visible in ((-1.1, False), (0.7, True)):
        scene.draw(quad(0.2), lamp(doubleSided=True), translation=[x, 0.3, 0],
                   extensions={"KHR_node_visibility": {"visible": visible}})
    scene.camera(orthographic(2, 2), translation=[0, 0, 5])
    yield place_case("hidden nodes stay hidden", "KHR_node_visibility", scene,
                     seen_at((0.7, 0.3, 0)))
    scene = Scene()
    mesh = scene.mesh(quad(0.2), lamp((1, 0, 0)))
    second = scene.add("materials", lamp((0, 0.5, 0.25)))
    scene.json["extensions"] = {"KHR_materials_variants": {"variants": [{"name": "other"}]}}
    scene.json["meshes"][mesh]["primitives"][0]["extensions"] = {"KHR_materials_variants": {
        "mappings": [{"material": second, "variants": [0]}]}}
    scene.node(mesh=mesh)
    scene.seen_from()
    yield Case("variant: its material", "KHR_materials_variants", scene, (0, 0.5, 0.25),
               options=("--variant", "other"))
    # A square of bytes from -100 to 100, normalized, so 100 / 127 wide.
    scene = Scene()
    corners = [(-100, -100, 0, 0), (100, -100, 0, 0), (100, 100, 0, 0), (-100, 100, 0, 0)]
    data = scene.view(bytes(c & 255 for corner in corners for c in corner))
    scene.json["bufferViews"][data]["byteStride"] = 4
    position = scene.add("accessors", {
        "bufferView": data, "componentType": 5120, "normalized": True, "count": 4, "type": "VEC3",
        "min": [-100, -100, 0], "max": [100, 100, 0]})
    scene.add("meshes", {"primitives": [{
        "attributes": {"POSITION": position}, "material": scene.add("materials", lamp()),
        "indices": scene.accessor("SCALAR", [0, 1, 2, 0, 2, 3], UINT)}]})
    scene.json["extensionsRequired"] = scene.json["extensionsUsed"] = ["KHR_mesh_quantization"]
    scene.node(mesh=0)
    scene.camera(orthographic(2, 2), translation=[0, 0, 5])
    part = (100 / 127 / 2)**2
    yield Case("quantized: a square of bytes", "KHR_mesh_quantization", scene, (part,) * 3,
               samples=1024, size=(16, 16), near=0.002)

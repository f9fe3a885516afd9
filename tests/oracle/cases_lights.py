# SPDX-License-Identifier: Apache-2.0
"""Punctual lights on diffuse walls, whose normals nodes transform."""
import math

from case import Case, group
from scene import Scene, lambert, lamp, quad
from vectors import cross, direction, dot, facing, normalize, rotated, times, turn

PUNCTUAL = "KHR_lights_punctual"
COLOR = (0.9, 0.5, 0.1)


def lambert_under(irradiance, light_color=(1, 1, 1), base_color=COLOR):
    """L = baseColor E / pi"""
    return tuple(b * c * irradiance / math.pi for b, c in zip(base_color, light_color))


def wall(view=(0, 0, 1)):
    """The point at the origin of a diffuse wall in z = 0."""
    scene = Scene()
    scene.draw(quad(), lambert(COLOR))
    scene.seen_from(view)
    return scene


@group
def directional():
    for polar, azimuth, view in ((0, 0, 0), (30, 90, 0), (60, 200, 0), (80, 45, 0), (45, 0, 60)):
        scene = wall(direction(view, 180))
        scene.sun(direction(polar, azimuth), 2.5)
        yield Case(f"directional: light at {polar}, {azimuth}, view at {view}",
                   f"{PUNCTUAL}, Directional; Appendix B, Diffuse BRDF", scene,
                   lambert_under(2.5 * math.cos(math.radians(polar))))
    scene = wall()
    scene.sun((0, 0, 1), 1.5, color=[0.2, 1, 0.6])
    yield Case("directional: colored", f"{PUNCTUAL}, Light Shared Properties", scene,
               lambert_under(1.5, (0.2, 1, 0.6)))
    scene = wall()
    scene.light("directional")
    yield Case("directional: default intensity, shines along -z", f"{PUNCTUAL}, Adding Light "
               "Instances to Nodes", scene, lambert_under(1))
    scene = wall()
    place = {"scale": [3, 0.5, 2], "translation": [5, 6, -7], "rotation": facing(direction(40, 10))}
    scene.light("directional", place=place, intensity=2)
    yield Case("directional: scale and place do not count", f"{PUNCTUAL}, Directional", scene,
               lambert_under(2 * math.cos(math.radians(40))))
    scene = wall()
    scene.sun(direction(120, 30), 4)
    yield Case("directional: from behind", "Appendix B, Diffuse BRDF", scene, (0, 0, 0))
    scene = wall()
    scene.sun(direction(20, 0), 1, color=[1, 0, 0])
    scene.sun(direction(70, 90), 2, color=[0, 1, 0])
    scene.light("point", place={"translation": [0, 0, 3]}, intensity=3, color=[0, 0, 1])
    lux = (math.cos(math.radians(20)), 2 * math.cos(math.radians(70)), 3 / 9)
    # One of three lights at each sample: an estimate is three times its light at most.
    yield Case("directional: several lights add up", "radiometry: light is additive", scene,
               tuple(c * e / math.pi for c, e in zip(COLOR, lux)), samples=4096,
               most=3 * max(lux) / math.pi)


@group
def point():
    for distance in (0.5, 1, 3, 20):
        for polar in (0, 50):
            scene = wall(direction(25))
            scene.light("point", place={"translation": times(distance, direction(polar, 130))},
                        intensity=0.6)
            lux = 0.6 * math.cos(math.radians(polar)) / distance**2
            yield Case(f"point: {distance} m away at {polar} degrees", f"{PUNCTUAL}, Point", scene,
                       lambert_under(lux))
    scene = wall()
    outer = scene.node(scale=[2, 2, 2], rotation=turn((0, 1, 0), 30))
    scene.light("point", outer, {"translation": [0, 0, 1]}, intensity=3, color=[1, 0.5, 0.25])
    yield Case("point: placed by a scaled and turned parent", f"{PUNCTUAL}, Point", scene,
               lambert_under(3 * math.cos(math.radians(30)) / 4, (1, 0.5, 0.25)))
    scene = wall()
    scene.light("point", place={"translation": [0, 0, 2]}, intensity=9, range=1.9)
    yield Case("point: nothing beyond its range", f"{PUNCTUAL}, Range Property", scene, (0, 0, 0))
    for reach in (2.2, 4):
        scene = wall()
        scene.light("point", place={"translation": [0, 0, 2]}, intensity=9, range=reach)
        window = max(min(1 - (2 / reach)**4, 1), 0)
        yield Case(f"point: fades before its range of {reach}", f"{PUNCTUAL}, Range Property",
                   scene, lambert_under(9 * window / 4))


def angular_attenuation(inner, outer, angle):
    scale = 1 / max(0.001, math.cos(inner) - math.cos(outer))
    offset = -math.cos(outer) * scale
    return min(max(math.cos(angle) * scale + offset, 0.0), 1.0)**2


@group
def spot():
    def case(name, angle, light, inner=0.0, outer=math.pi / 4, at=(0, 0, 2), more=None):
        """A spot that looks past the origin by an angle in degrees."""
        scene = wall()
        aside = turn(normalize(cross(at, (0.6, 0.8, 0))), angle)
        back = rotated(normalize(at), aside)  # from where it looks, its own +z
        scene.light("spot", place={"translation": list(at), "rotation": facing(back),
                                   **(more or {})}, intensity=5, spot=light)
        distance = math.sqrt(dot(at, at))
        lux = (5 * angular_attenuation(inner, outer, math.radians(angle)) * at[2] / distance**3)
        return Case(f"spot: {name}", f"{PUNCTUAL}, Inner and Outer Cone Angles", scene,
                    lambert_under(lux))
    cone = {"innerConeAngle": 0.3, "outerConeAngle": 0.7}
    for angle in (0, 16, 20, 25, 30, 37, 41):
        yield case(f"{angle} degrees off, cone 0.3 to 0.7", angle, cone, 0.3, 0.7)
    yield case("default cone, 30 degrees off", 30, {})
    yield case("widest cone, 70 degrees off", 70, {"outerConeAngle": math.pi / 2}, 0, math.pi / 2)
    yield case("hard edge, inside", 34, {"innerConeAngle": 0.6, "outerConeAngle": 0.6001},
               0.6, 0.6001)
    yield case("from aside, 25 degrees off", 25, cone, 0.3, 0.7, at=(1, -0.5, 1.5))
    yield case("scale does not count", 25, cone, 0.3, 0.7, more={"scale": [4, 1, 0.5]})


# Normals of transformed objects: by the inverse transpose of the matrix.

def transformed_normal(scale, rotation, normal):
    return rotated(normalize(tuple(n / s for n, s in zip(normal, scale))), rotation)


@group
def transforms():
    tilt = turn((1, 0, 0), 50)
    for scale in ((1, 1, 1), (4, 1, 1), (1, 0.25, 3), (1, 2, 0.5)):
        scene = Scene()
        outer = scene.node(scale=list(scale))
        scene.draw(quad(), lambert(COLOR), outer, rotation=tilt)
        normal = transformed_normal(scale, [0, 0, 0, 1], rotated((0, 0, 1), tilt))
        scene.seen_from()
        scene.sun(direction(30, 120), 3)
        yield Case(f"transform: tilted in a scale of {scale}", "Transformations (3.5.3)", scene,
                   lambert_under(3 * max(0, dot(normal, direction(30, 120)))))
    scene = Scene()
    smooth = normalize((0.3, -0.4, 1))
    scene.draw(quad().having(NORMAL=[smooth] * 4), lambert(COLOR), scale=[2, 0.5, 1],
               rotation=turn((0, 1, 0), 20))
    scene.seen_from()
    scene.sun((0, 0, 1), 3)
    normal = transformed_normal((2, 0.5, 1), turn((0, 1, 0), 20), smooth)
    yield Case("transform: smooth normal under a scale", "Meshes (3.7.2), NORMAL", scene,
               lambert_under(3 * normal[2]))
    scene = Scene()
    scene.draw(quad(), lambert(COLOR), rotation=turn((0, 1, 0), 180), scale=[1, 1, -1])
    scene.seen_from()
    scene.sun((0, 0, 1), 3)
    yield Case("transform: mirrored, so its winding turns around", "Instantiation (3.7.4)", scene,
               lambert_under(3))
    scene = Scene()
    # Column by column: 40 degrees about x, after a scale.
    c, s = math.cos(math.radians(40)), math.sin(math.radians(40))
    scene.draw(quad(), lambert(COLOR),
               matrix=[2, 0, 0, 0, 0, 3 * c, 3 * s, 0, 0, -0.5 * s, 0.5 * c, 0, 0, 0, 0, 1])
    scene.seen_from()
    scene.sun((0, 0, 1), 3)
    yield Case("transform: a matrix", "Transformations (3.5.3)", scene, lambert_under(3 * c))
    scene = Scene()
    flat = quad().without("NORMAL")
    scene.draw(flat, lambert(COLOR), rotation=turn((0, 1, 0), 35))
    scene.seen_from()
    scene.sun((0, 0, 1), 3)
    yield Case("transform: flat normals where there are none", "Meshes (3.7.2), NORMAL", scene,
               lambert_under(3 * math.cos(math.radians(35))))


@group
def sides():
    for sided in (False, True):
        for lit_from in (-1, 1):
            scene = Scene()
            scene.draw(quad(), lambert(COLOR, doubleSided=sided), rotation=turn((0, 1, 0), 180))
            scene.draw(quad(), lamp((0.25, 0.5, 0.75)), translation=[0, 0, -3])
            scene.seen_from()
            scene.sun((0, 0.6, lit_from * 0.8), 2)
            lit = lambert_under(2 * 0.8) if lit_from > 0 else (0, 0, 0)
            yield Case(f"sides: back of a {'double' if sided else 'single'}-sided wall, light from "
                       f"{'here' if lit_from > 0 else 'behind'}", "Double Sided (3.9.5)", scene,
                       lit if sided else (0.25, 0.5, 0.75))

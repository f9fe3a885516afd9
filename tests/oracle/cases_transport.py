# SPDX-License-Identifier: Apache-2.0
"""Light from all around and between surfaces: furnaces, skies, cavities, lamps, shadows, mirrors
and thin walls of glass."""
import math

from brdf import (coated, dielectric_fresnel, diffuse_brdf, directional_albedo, iridescent_fresnel,
                  metallic_roughness, product, scaled, schlick, sheen_albedo, specular_brdf,
                  with_sheen)
from case import Case, centroid, group
from pictures import hdr
from scene import (NO_SPECULAR, Scene, box, lambert, lamp, material, orthographic, perspective,
                   quad, sphere)
from transport import polygon_irradiance
from vectors import direction, dot, facing, normalize, plus, times, turn

COLOR = (0.9, 0.5, 0.1)
WHITE = (".hdr", hdr([[(1, 1, 1)] * 2]))
MANY = {"samples": 1024, "size": (12, 12)}


def in_white_light(name, source, made_of, view, expected, **more):
    """The point at the origin of a wall."""
    scene = Scene()
    scene.draw(quad().having(TANGENT=[(1, 0, 0, 1)] * 4), made_of)
    scene.seen_from(direction(view))
    return Case(name, source, scene, expected, sky=WHITE, **{"most": 1.5, **MANY, **more})


@group
def furnaces():
    for shader in ("spec", "conserving"):
        scene = Scene()
        scene.draw(sphere(1, 16), lambert((1, 1, 1)))
        scene.camera(orthographic(1.2, 1.2), translation=[0, 0, 4])
        yield Case(f"furnace: a white ball, {shader}", "Appendix B, energy conservation", scene,
                   (1, 1, 1), sky=WHITE, most=1.2, shader=shader, **MANY)
        yield in_white_light(f"furnace: a diffuse wall, {shader}", "Appendix B, Diffuse BRDF",
                             lambert(COLOR), 30, COLOR, shader=shader)
    for roughness, view in ((0.3, 70), (0.6, 0), (1, 0), (1, 75)):
        yield in_white_light(f"furnace: white metal of roughness {roughness}, view {view}, conserving",
                             "Turquin 2019", material((1, 1, 1), 1, roughness), view, (1, 1, 1),
                             shader="conserving", near=2e-3)
    film = {"iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1,
                            "iridescenceThicknessMaximum": 700}}
    for view in (0, 60):  # which is no film
        yield in_white_light(f"furnace: a film of air on white plastic, view {view}, conserving",
                             "KHR_materials_iridescence", material(
                                 (1, 1, 1), 0, 0.1, extensions=film), view, (0.995, 0.995, 0.995),
                             shader="conserving", near=6e-3)
    film = {"iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.8,
                            "iridescenceThicknessMaximum": 350}}
    cloth = {"sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 0.3}}
    strong = {"anisotropy": {"anisotropyStrength": 1}}
    pane = {"transmission": {"transmissionFactor": 1}}
    for what, metallic, extensions in (
            ("a film on white plastic", 0, film), ("a film on a pane", 0, {**film, **pane}),
            ("sheen on white metal", 1, cloth), ("sheen on a pane", 0, {**cloth, **pane}),
            ("anisotropic plastic", 0, strong), ("anisotropic metal", 1, strong)):
        for view in (0, 75):
            yield in_white_light(f"furnace: {what}, view {view}, conserving",
                                 "all light comes back", material(
                                     (1, 1, 1), metallic, 0.4, extensions=extensions), view,
                                 (0.994, 0.994, 0.994), shader="conserving", near=1e-2)
    yield in_white_light("furnace: unlit", "KHR_materials_unlit",
                         material(COLOR, extensions={"unlit": {}}), 30, COLOR)
    leaf = {"diffuse_transmission": {"diffuseTransmissionFactor": 0.3,
                                     "diffuseTransmissionColorFactor": [0.2, 0.8, 1]}}
    yield in_white_light("furnace: a leaf, light from both sides",
                         "KHR_materials_diffuse_transmission", lambert(
                             COLOR, leaf, doubleSided=True), 20,
                         plus(scaled(0.7, COLOR), scaled(0.3, (0.2, 0.8, 1.0))))
    source = "Appendix B, integrated over all lights"

    def integral(view, brdf):
        return lambda: directional_albedo(brdf, math.cos(math.radians(view)))
    for roughness, metallic, view in ((0.5, 1, 0), (0.7, 1, 60), (1, 1, 30), (1, 1, 75),
                                      (0.5, 0, 20), (0.8, 0, 70), (0.6, 0.5, 45)):
        yield in_white_light(f"furnace: roughness {roughness}, metallic {metallic}, view {view}",
                             source, material(COLOR, metallic, roughness), view,
                             integral(view, lambda p, m=metallic, r=roughness: metallic_roughness(
                                 p, COLOR, m, r)))
    coat = {"clearcoat": {"clearcoatFactor": 0.9, "clearcoatRoughnessFactor": 0.5}}
    yield in_white_light("furnace: clearcoat", "KHR_materials_clearcoat", material(
        COLOR, 1, 0.8, extensions=coat), 50, integral(50, lambda p: coated(
            p, metallic_roughness(p, COLOR, 1, 0.8), 0.9, 0.5)))
    film = {"iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.6,
                            "iridescenceThicknessMaximum": 350}}
    yield in_white_light("furnace: iridescence", "KHR_materials_iridescence", material(
        COLOR, 1, 0.6, extensions=film), 40, integral(40, lambda p: scaled(
            specular_brdf(0.36, p), iridescent_fresnel(1.6, COLOR, 350, p.v_h))))
    cloth = {"sheen": {"sheenColorFactor": [0.9, 0.6, 0.3], "sheenRoughnessFactor": 0.7}}
    for view in (20, 70):
        cosine = math.cos(math.radians(view))
        yield in_white_light(f"furnace: sheen alone, view {view}", "KHR_materials_sheen, Implemen"
                             "tation Notes", lambert((0, 0, 0), cloth), view,
                             lambda c=cosine: scaled(sheen_albedo(0.7, c), (0.9, 0.6, 0.3)))
    yield in_white_light("furnace: sheen on a diffuse wall", "KHR_materials_sheen, Albedo-scaling",
                         lambert(COLOR, cloth), 50, integral(50, lambda p: with_sheen(
                             p, diffuse_brdf(COLOR), (0.9, 0.6, 0.3), 0.7)))
    # Mirrors: the angle of the facet is that of the view.
    for view in (0, 45, 75):
        cosine = math.cos(math.radians(view))
        yield in_white_light(f"furnace: a mirror, view {view}", "Appendix B, Fresnel",
                             material(COLOR, 1, 0), view, schlick(COLOR, cosine))
        yield in_white_light(
            f"furnace: a smooth layer on a diffuse wall, view {view}", source,
            material(COLOR, 0, 0), view, lambda v=view, c=cosine: plus(
                dielectric_fresnel(c), directional_albedo(lambda p: scaled(
                    1 - dielectric_fresnel(p.v_h)[0], diffuse_brdf(COLOR)), c)))


# Skies that vary with height only.

ROWS = 64


def sky_of(function):
    """`function` of the height, -1 to 1; it varies little between rows."""
    rows = []
    for row in range(ROWS):
        grey = function(math.cos(math.pi * (row + 0.5) / ROWS))
        rows.append([(grey,) * 3] * 4)
    return ".hdr", hdr(rows)


def irradiance(function, normal, steps=160):
    """The integral of radiance times cosine, by the midpoint rule over the sphere."""
    total = 0.0
    for i in range(steps):
        height = -1 + 2 * (i + 0.5) / steps
        radius = math.sqrt(1 - height**2)
        ring = 0.0
        for j in range(steps):
            a = 2 * math.pi * (j + 0.5) / steps
            ring += max(0.0, dot(normal, (radius * math.cos(a), height, radius * math.sin(a))))
        total += function(height) * ring
    return total * 4 * math.pi / steps**2


@group
def skies():
    # RGBE has 8 bits: 1 / 256 of a step at most, half of it on average, downwards.
    coarse = 1 / 256
    for name, function in (("brighter upwards", lambda y: (1 + y) / 2),
                           ("bright horizon", lambda y: 1 - y * y),
                           ("lit from above alone", lambda y: max(y, 0.0))):
        for tilt in (0, 60, 90, 150):
            scene = Scene()
            normal = direction(90 - tilt, 90)  # 0: upwards, 90: towards +z
            scene.draw(quad(), lambert((1, 1, 1)), rotation=facing(normal))
            scene.seen_from(normal)
            yield Case(f"sky: {name}, a wall tilted by {tilt}", "radiometry: E = integral L cos",
                       scene, lambda f=function, n=normal: (irradiance(f, n) / math.pi,) * 3,
                       sky=sky_of(function), most=2, near=coarse, **MANY)
    for height, toward in ((0.8, direction(90 - 53.13010, 90)), (-0.6, direction(126.8699, 90))):
        scene = Scene()
        scene.draw(quad(), lamp(), translation=[50, 0, 0])
        scene.seen_from(times(-1, toward))
        yield Case(f"sky: seen at a height of {height}", "equirectangular images", scene,
                   ((1 + toward[1]) / 2,) * 3, sky=sky_of(lambda y: (1 + y) / 2), near=coarse)
    scene = Scene()
    scene.draw(quad(), material(COLOR, 1, 0))
    scene.seen_from(direction(50, -90))
    bright = (1 + direction(50, 90)[1]) / 2
    yield Case("sky: in a mirror", "Appendix B, Fresnel", scene,
               scaled(bright, schlick(COLOR, math.cos(math.radians(50)))),
               sky=sky_of(lambda y: (1 + y) / 2), near=coarse, most=1.5, **MANY)
    scene = Scene()
    scene.draw(quad(), lambert(COLOR))
    scene.seen_from()
    yield Case("sky: exposure counts", "ISO 2720", scene, scaled(2, COLOR), sky=WHITE, most=2.5,
               options=("--exposure", "1"), **MANY)


@group
def cavities():
    eye = {"translation": [0.3, 0.1, 0.7], "rotation": turn((0, 1, 0), 25)}
    for name, shape in (("box", box(1, 2, 1.5)), ("ball", sphere(1.5, 24))):
        for albedo, emission in (((0.5, 0.8, 0.2), (0.4, 0.1, 1)),
                                 ((0.1, 0.6, 0.7), (0.9, 0.2, 0.15))):
            scene = Scene()
            scene.draw(shape, lambert(albedo, emissiveFactor=list(emission), doubleSided=True))
            scene.camera(perspective(1.2), **eye)
            yield Case(f"cavity: a shining {name}, albedo {albedo}",
                       "L = Le + albedo L, the same everywhere", scene,
                       tuple(e / (1 - a) for e, a in zip(emission, albedo)), most=4, bounces=64,
                       **MANY)
    # Light that a wall of a ball scatters reaches all of it alike: after the first time, E is
    # albedo / (1 - albedo) of its mean, I / r^2.
    for place in ((0, 0, 0), (0.8, 0.2, 0)):
        radius, candela, albedo = 2.0, 1.5, (0.3, 0.6, 0.8)
        scene = Scene()
        scene.draw(sphere(radius, 96), lambert(albedo, doubleSided=True))
        scene.light("point", place={"translation": list(place)}, intensity=candela)
        # Aside from the poles and edges of the mesh.
        at = times(radius, direction(50.3, 61.1))
        scene.seen_from(times(-1, at), at=at, distance=1)
        to_light = plus(place, times(-1, at))
        squared = dot(to_light, to_light)
        direct = candela * dot(to_light, times(-1 / radius, at)) / squared**1.5
        mean = candela / radius**2
        # Facets are up to 1 - cos(pi / 192) nearer than the ball.
        yield Case(f"cavity: a lamp at {place} in a ball", "integrating sphere (Ulbricht, 1900)",
                   scene, tuple(a / math.pi * (direct + mean * a / (1 - a)) for a in albedo),
                   most=2, near=1e-3, bounces=64, **MANY)


@group
def area_lamps():
    def case(name, corners, normal=(0, 0, 1), blocker=None):
        """`corners`: of a lamp above the origin, counter-clockwise seen from there."""
        radiance = (0.8, 0.6, 0.2)
        scene = Scene()
        scene.draw(quad(0.1), lambert(COLOR), rotation=facing(normal))
        shape = quad()
        shape.attributes["POSITION"] = list(corners)
        scene.draw(shape.without("NORMAL", "TEXCOORD_0"), lamp(radiance, doubleSided=True))
        seen = polygon_irradiance(corners, normal)
        if blocker:
            shape = quad()
            shape.attributes["POSITION"] = list(blocker)
            scene.draw(shape.without("NORMAL", "TEXCOORD_0"), lambert((0, 0, 0), doubleSided=True))
            seen -= polygon_irradiance(blocker, normal)
        scene.seen_from(plus(normal, (0.05, 0.9, 0)), distance=0.3)
        return Case(f"area lamp: {name}", "Lambert, Photometria", scene,
                    tuple(c * r * seen / math.pi for c, r in zip(COLOR, radiance)), most=2, **MANY)
    above = ((1, 1, 1), (-1, 1, 1), (-1, -1, 1), (1, -1, 1))
    yield case("overhead", above)
    yield case("overhead, far", tuple((x, y, 4.0) for x, y, _ in above))
    yield case("aside", tuple((x + 2, y, z) for x, y, z in above))
    yield case("an upright wall", ((1, -1, 0.2), (1, 1, 0.2), (1, 1, 2), (1, -1, 2)))
    yield case("on a tilted wall", above, normal=normalize((0.2, -0.3, 1)))
    yield case("half covered", above,
               blocker=((0, 0.5, 0.5), (-0.5, 0.5, 0.5), (-0.5, -0.5, 0.5), (0, -0.5, 0.5)))


# Shadows and images in mirrors.

@group
def shadows():
    """A plate above the right half of a wall, and the part of a picture in its shadow."""
    half, view = 0.25, 75
    reach = half / math.cos(math.radians(view))  # of the picture on the wall
    for polar, azimuth, height in ((45, 0, 0.3), (60, 180, 0.2), (30, 50, 0.9)):
        toward = direction(polar, azimuth)
        scene = Scene()
        scene.draw(quad(9), lambert((1, 1, 1)))
        scene.draw(quad(9), lambert((0, 0, 0), doubleSided=True), translation=[9, 0, height])
        scene.seen_from(direction(view, 180), half=half, at=(-0.3, 0, 0))  # below the plate
        scene.sun(toward, 2)
        edge = -height * toward[0] / toward[2]
        lit = (edge + 0.3 + reach) / (2 * reach)
        yield Case(f"shadow: edge of a plate {height} above a wall, sun at {polar}, {azimuth}",
                   "geometry", scene, (lit * 2 * toward[2] / math.pi,) * 3, samples=256,
                   size=(16, 16), near=0.002)


@group
def single_sided_shadows():
    """A black sheet whose front faces the sun: whatever else its material can do, its shadow is
    black."""
    black_leaf = {"diffuse_transmission": {"diffuseTransmissionFactor": 0.5,
                                           "diffuseTransmissionColorFactor": [0, 0, 0]}}
    for name, more in (("opaque", {}), ("a leaf", black_leaf)):
        for sided in (True, False):
            scene = Scene()
            scene.draw(quad(), lambert(COLOR))
            scene.draw(quad(0.3), lambert((0, 0, 0), more, doubleSided=sided),
                       translation=[0, 0, 0.5])
            scene.seen_from(direction(60))
            scene.sun((0, 0, 1), 2)
            yield Case(f"shadow: of a {'double' if sided else 'single'}-sided black sheet, {name}",
                       "docs/bake.md, What is drawn", scene, (0, 0, 0), samples=64,
                       limit="" if more is not black_leaf or sided else
                       "single-sided surfaces that transmit light cast no shadow")


@group
def mirrors():
    for view, place in ((30, (0.4, 0.2, 1.0)), (60, (-0.5, -0.3, 0.6))):
        scene = Scene()
        scene.draw(quad(9), material((1, 1, 1), 1, 0))
        scene.draw(quad(0.15 / math.cos(math.radians(view)), 0.15), lamp(), translation=list(place),
                   rotation=[1, 0, 0, 0])
        scene.seen_from(direction(view), half=1.5)
        cosine, sine = math.cos(math.radians(view)), math.sin(math.radians(view))
        x = place[0] * cosine + place[2] * sine  # of the image behind the mirror
        yield Case(f"mirror: the image of a lamp, view {view}", "law of reflection", scene,
                   ((x / 1.5 + 1) * 8, (1 - place[1] / 1.5) * 8), measure=centroid, samples=1024,
                   size=(16, 16), near=0.03)
        scene = Scene()
        scene.draw(quad(), material((0.9, 0.5, 0.1), 1, 0))
        away = direction(view, 180)
        scene.draw(quad(0.5), lamp((0.5, 1, 0.5)), translation=list(times(2, away)),
                   rotation=facing(times(-1, away)))
        scene.seen_from(direction(view))
        yield Case(f"mirror: reflects by Fresnel, view {view}", "Appendix B, Fresnel", scene,
                   product(schlick((0.9, 0.5, 0.1), cosine), (0.5, 1.0, 0.5)))


# Thin walls of glass: roughness 0.

def glass(base_color=(1, 1, 1), metallic=0.0, factor=1.0, more=None, **rest):
    return material(base_color, metallic, 0, extensions={
        "transmission": {"transmissionFactor": factor}, **(more or {})}, **rest)


@group
def thin_walls():
    source = "KHR_materials_transmission, Transmission BTDF"
    behind = (1.0, 0.8, 0.6)
    for view, factor, metallic, ior in ((0, 1, 0, 1.5), (60, 1, 0, 1.5), (75, 1, 0, 2),
                                        (30, 0.4, 0, 1.5), (0, 1, 0.7, 1.5)):
        scene = Scene()
        scene.draw(quad(), glass(COLOR, metallic, factor, {"ior": {"ior": ior}}, doubleSided=True))
        scene.draw(quad(20), lamp(behind), translation=[0, 0, -1])
        scene.seen_from(direction(view))
        through = (1 - metallic) * factor * (1 - dielectric_fresnel(
            math.cos(math.radians(view)), ior=ior)[0])
        yield Case(f"thin wall: view {view}, factor {factor}, metallic {metallic}, ior {ior}",
                   source, scene, scaled(through, product(COLOR, behind)), most=1, **MANY)
    # Two walls: light is reflected between them. R + T^2 / (1 - R^2) R..., in white light.
    scene = Scene()
    for z in (0, -0.5):
        scene.draw(quad(20), glass(COLOR, doubleSided=True), translation=[0, 0, z])
    scene.seen_from(direction(40))
    r = dielectric_fresnel(math.cos(math.radians(40)))[0]
    passed = scaled(1 - r, COLOR)
    yield Case("thin wall: two of them in white light", "geometric series", scene, tuple(
        r + t * t * r / (1 - r * r) + t * t / (1 - r * r) for t in passed), sky=WHITE, most=1,
        bounces=32, **MANY)
    scene = Scene()
    scene.draw(box(1, 1, 1), glass(COLOR, doubleSided=True))
    scene.seen_from()
    yield Case("thin wall: a hollow cube in white light", "geometric series", scene,
               tuple(0.04 + 0.96 * c * c for c in COLOR), sky=WHITE, most=1, bounces=32, **MANY)

    # A floor below panes: parallel light goes straight through a thin wall.
    tint = (0.9, 0.6, 0.3)
    for name, angle, factor, more in (("without specular weight", 0, 1, NO_SPECULAR), ("", 0, 1, {}),
                                      ("from aside", 50, 1, {}), ("half transmissive", 20, 0.5, {})):
        scene = Scene()
        scene.draw(quad(), lambert(COLOR))
        scene.draw(quad(5), glass(tint, factor=factor, doubleSided=True, more=more),
                   translation=[0, 0, 0.5])
        scene.seen_from(direction(60), distance=0.4)
        scene.sun(direction(angle, 180), 2)
        mu = math.cos(math.radians(angle))
        passed = factor * (1 if more else 1 - dielectric_fresnel(mu)[0])
        yield Case(f"thin wall: the sun through a pane, on a wall {name}".rstrip(), source, scene,
                   scaled(2 * mu * passed, diffuse_brdf(product(COLOR, tint))), most=1,
                   **{**MANY, "bounces": 1})

# SPDX-License-Identifier: Apache-2.0
"""Light in volumes: glass that bends and absorbs, and media that scatter."""
import math

from case import BLACK, Case, centroid, group
from cases_transport import MANY, WHITE, glass, sky_of
from scene import NO_SPECULAR, Scene, Shape, box, lamp, orthographic, quad, sphere
from transport import (HalfSpace, forward_slab, refracted, single_scatter_albedo, slab_of_medium,
                       slab_radiance)
from vectors import direction, turn


def volume(ior, thickness=1.0, distance=None, color=None, more=None, base_color=(1, 1, 1)):
    medium = {"thicknessFactor": thickness}
    if distance:
        medium.update(attenuationDistance=distance, attenuationColor=list(color))
    return glass(base_color, more={"ior": {"ior": ior}, "volume": medium, **(more or {})})


def slab(made_of, thick, view, wide=40, **node):
    """Its front face is in z = 0, far wider than thick."""
    scene = Scene()
    scene.draw(box(wide, wide, thick / 2), made_of, **{"translation": [0, 0, -thick / 2], **node})
    scene.seen_from(direction(view))
    return scene


@group
def slabs():
    source = "KHR_materials_volume, Attenuation and Implementation"
    color = (0.9, 0.5, 0.2)

    def absorbed(ior, view, thick, distance):
        path = thick / refracted(math.cos(math.radians(view)), ior)
        return tuple(c**(path / distance) for c in color)

    def expected(ior, view, thick=1.0, distance=1.5, **more):
        cosine = math.cos(math.radians(view))
        return tuple(slab_radiance(cosine, ior, t, **more)
                     for t in absorbed(ior, view, thick, distance))

    def case(name, made_of, view, numbers, **node):
        return Case(f"slab: {name}", source, slab(made_of, 1, view, **node), numbers, sky=WHITE,
                    most=1, bounces=32, **MANY)
    for ior in (1.0, 1.33, 1.5, 2.2):
        for view in (0, 45, 70):
            yield case(f"ior {ior}, view {view}", volume(ior, 1, 1.5, color), view,
                       expected(ior, view))
    yield case("rays know better than thicknessFactor", volume(1.5, 0.01, 1.5, color), 30,
               expected(1.5, 30))
    yield case("lengths are those of the world", volume(1.5, 1, 1.5, color), 30,
               expected(1.5, 30, thick=2.5), scale=[1, 1, 2.5], translation=[0, 0, -1.25])
    yield case("base color at each face", volume(1.5, 1, 1.5, color, base_color=(0.8, 0.8, 0.8)),
               30, expected(1.5, 30, tint=0.8))
    half = {"specular": {"specularFactor": 0.5}}
    yield case("specular factor", volume(1.8, 1, 1.5, color, half), 50,
               expected(1.8, 50, weight=0.5))
    yield case("without attenuation", volume(1.7), 60, (1, 1, 1))
    for distance in (0.2, 5):
        yield case(f"attenuation distance {distance}",
                   volume(1.4, 1, distance, color), 20, expected(1.4, 20, distance=distance))


def channel_centroid(channel):
    def measure(picture):
        for row in picture.rows:
            row[:] = [(0, pixel[channel], 0) for pixel in row]
        return centroid(picture)
    return measure


@group
def refraction():
    """A small lamp behind a slab, seen from aside. Without the weight of the specular layer there
    are no ghosts; rays bend by the index only."""
    thick, depth, half = 1.0, 1.6, 0.25

    def shift(ior, view):
        """From where a ray meets the slab to where it meets the plane of the lamp."""
        inside = refracted(math.cos(math.radians(view)), ior)
        return (thick * math.sqrt(1 - inside**2) / inside +
                (depth - thick) * math.tan(math.radians(view)))

    def case(name, source, ior, view, ior_seen, more=None, channel=1):
        lamp_x = 0.06 - shift(ior, view)
        # No wider than need be: rays start off a surface by a part of the size of the scene.
        scene = slab(volume(ior, more={**NO_SPECULAR, **(more or {})}), thick, view, wide=2)
        scene.json["cameras"] = [orthographic(half, half)]
        scene.draw(quad(0.05), lamp(doubleSided=True), translation=[lamp_x, 0, -depth])
        seen = (lamp_x + shift(ior_seen, view)) * math.cos(math.radians(view))
        return Case(f"refraction: {name}", source, scene, ((seen / half + 1) * 8, 8.0),
                    size=(16, 16), samples=1024, near=0.03, measure=channel_centroid(channel))
    for ior, view in ((1.0, 40), (1.33, 30), (1.5, 60), (2.4, 50)):
        yield case(f"ior {ior}, view {view}", "KHR_materials_volume, Refraction; Snell", ior, view,
                   ior)
    for ior, dispersion, view in ((1.5, 1, 60), (1.7, 4, 50)):
        spread = (ior - 1) * 0.025 * dispersion
        for channel, name in enumerate(("red", "green", "blue")):
            yield case(f"dispersion {dispersion}, ior {ior}, {name}",
                       "KHR_materials_dispersion, Implementation", ior, view,
                       ior + (channel - 1) * spread, {"dispersion": {"dispersion": dispersion}},
                       channel)


def prism():
    """Its legs are in x = -1, seen by a camera there, and y = -1; light turns at the long side."""
    corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)]
    positions = [(x, y, z) for z in (-2.0, 2.0) for x, y in corners]
    triangles = [(0, 2, 1), (3, 4, 5)]
    for i, j in ((0, 1), (1, 2), (2, 0)):
        triangles += [(i, j, j + 3), (i, j + 3, i + 3)]
    return Shape(triangles, POSITION=positions)


@group
def total_reflection():
    for name, more, passed in (("", {}, 0.96), (" without specular weight", NO_SPECULAR, 1.0)):
        scene = Scene()
        scene.draw(prism(), volume(1.5, more=more))
        scene.draw(quad(3), lamp((0.5, 1, 0.25)), translation=[0, -3, 0],
                   rotation=turn((1, 0, 0), -90))
        scene.seen_from((-1, 0, 0), at=(-1, -0.1, 0.1))
        # Both faces, and light that is reflected between them.
        part = passed**2 / (1 - (1 - passed)**2)
        yield Case(f"prism: total reflection{name}", "KHR_materials_volume, Implementation", scene,
                   tuple(part * c for c in (0.5, 1, 0.25)), most=1, bounces=32, **MANY)


@group
def balls():
    """The mean over the chords of a ball that absorbs: 2 (1 - (1 + s) exp(-s)) / s^2 for a
    diameter of s free paths."""
    colors, distance = (0.9, 0.4, 0.05), 1.5
    scene = Scene()
    scene.draw(sphere(1, 96), volume(1.0, 1, distance, colors, NO_SPECULAR))
    half = 1.25
    scene.camera(orthographic(half, half), translation=[0, 0, 4])
    diameters = [2 * -math.log(c) / distance for c in colors]
    passed = [2 * (1 - (1 + s) * math.exp(-s)) / s**2 for s in diameters]
    yield Case("ball: absorbs along its chords", "KHR_materials_volume, Attenuation", scene,
               tuple(1 - math.pi / 4 / half**2 * (1 - part) for part in passed), sky=WHITE,
               samples=1024, size=(16, 16), near=1e-3)


def medium(albedo_colors, anisotropy=0.0, sigma=1.0):
    """By KHR_materials_volume_scatter, with an index of 1 and without surface reflection."""
    return volume(1.0, 1, 1 / sigma, (math.exp(-1),) * 3, {
        **NO_SPECULAR, "volume_scatter": {"multiscatterColorFactor": list(albedo_colors),
                                          "scatterAnisotropy": anisotropy}})


@group
def media():
    source = "KHR_materials_volume_scatter; Chandrasekhar, Radiative Transfer"
    colors = (0.2, 0.5, 0.8)
    deep = {"sky": WHITE, "most": 1, "bounces": 64, **MANY}
    for view in (0, 40, 70):
        mu = math.cos(math.radians(view))
        yield Case(f"medium: a half space, view {view}", source, slab(medium(colors), 40, view),
                   lambda m=mu: tuple(HalfSpace(single_scatter_albedo(c)).plane_albedo(m)
                                      for c in colors), **deep)
    scatter = {"sss": {"scatterDistance": 1, "scatterColor": [math.exp(-0.5), math.exp(-0.8),
                                                              math.exp(-0.95)]}}
    absorbing = tuple(math.exp(w - 1) for w in (0.5, 0.8, 0.95))
    yield Case("medium: a half space by KHR_materials_sss", "KHR_materials_sss, Scattering",
               slab(volume(1.0, 1, 1, absorbing, {**NO_SPECULAR, **scatter}), 40, 50),
               lambda: tuple(HalfSpace(w).plane_albedo(math.cos(math.radians(50)))
                             for w in (0.5, 0.8, 0.95)), **deep)
    for thick, view in ((0.5, 0), (1, 60), (3, 30)):
        yield Case(f"medium: a slab of {thick} free paths, view {view}",
                   "Schwarzschild and Milne; KHR_materials_volume_scatter",
                   slab(medium(colors), thick, view),
                   lambda t=thick, v=view: tuple(slab_of_medium(
                       single_scatter_albedo(c), t, math.cos(math.radians(v))) for c in colors),
                   **deep)
    yield Case("medium: the same in a scaled node", "KHR_materials_volume, Properties",
               slab(medium(colors), 1, 30, scale=[1, 1, 3], translation=[0, 0, -1.5]),
               lambda: tuple(slab_of_medium(single_scatter_albedo(c), 3,
                                            math.cos(math.radians(30))) for c in colors), **deep)
    for anisotropy in (-0.5, 0.0, 0.7):
        # Lit from above only; its front faces up.
        scene = Scene()
        scene.draw(box(40, 40, 1), medium(colors, anisotropy), rotation=turn((1, 0, 0), -90))
        scene.seen_from(direction(70, 90))
        yield Case(f"medium: lit from one side, anisotropy {anisotropy}",
                   "KHR_materials_volume_scatter, Scatter Anisotropy", scene,
                   lambda g=anisotropy: tuple(forward_slab(
                       single_scatter_albedo(c), g, 2, math.sin(math.radians(70)))
                       for c in colors),
                   **{**deep, "sky": sky_of(lambda y: float(y > 0))}, near=2e-3)
    for anisotropy in (-0.6, 0.8):
        yield Case(f"medium: white, anisotropy {anisotropy}", "KHR_materials_volume_scatter",
                   slab(medium((1, 1, 1), anisotropy), 2, 30), (1, 1, 1),
                   **{**deep, "bounces": 500})
    yield Case("medium: black absorbs alone", "KHR_materials_volume, Attenuation",
               slab(medium((0, 0, 0)), 1, 45), (math.exp(-math.sqrt(2)),) * 3, **deep)
    scene = slab(medium(colors), 40, 10)
    scene.sun(direction(60, 180), 2)
    mu, mu0 = math.cos(math.radians(10)), math.cos(math.radians(60))
    yield Case("medium: a half space in the sun", source, scene, lambda: tuple(
        2 * HalfSpace(single_scatter_albedo(c)).reflected(mu, mu0) for c in colors),
        limit="punctual lights do not shine into media behind smooth surfaces",
        **{**deep, "sky": BLACK})

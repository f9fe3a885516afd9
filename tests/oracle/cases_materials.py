# SPDX-License-Identifier: Apache-2.0
"""BRDFs of Appendix B and of the material extensions: one point of a wall, one direction of the
view and one of the light, both known exactly."""
import math

from brdf import (Pair, anisotropic_brdf, coat_weight, coated, conserving_dielectric,
                  conserving_metal, dielectric_fresnel, diffuse_brdf, iridescent_fresnel, layered, metal_brdf,
                  metallic_roughness, mirrored, mix, rough_diffuse_brdf, scaled, schlick,
                  sheen_brdf, specular_brdf, specular_btdf, with_sheen)
from case import Case, group
from scene import Scene, lambert, lamp, material, quad
from vectors import direction, dot, normalize, plus

LUX = 2.0
COLOR = (0.9, 0.5, 0.1)
# Polar angle and azimuth of view and light.
MIRROR = ((35, 0), (35, 180))
NEAR_MIRROR = ((50, 10), (42, 200))
SAME_SIDE = ((60, 0), (40, 30))
GRAZING = ((80, 0), (70, 160))
ACROSS = ((20, 45), (65, 150))
COAXIAL = ((40, 0), (40, 0))
PAIRS = {"mirror": MIRROR, "near mirror": NEAR_MIRROR, "same side": SAME_SIDE, "grazing": GRAZING,
         "across": ACROSS, "coaxial": COAXIAL}


def wall(made_of, angles, shape=None):
    """(scene, Pair) of a wall in parallel light."""
    view, light = (direction(*one) for one in angles)
    scene = Scene()
    scene.draw(shape or quad(), made_of)
    scene.seen_from(view)
    scene.sun(light, LUX)
    return scene, Pair(view, light)


def radiance(brdf, light):
    return scaled(LUX * abs(light[2]), brdf)


def brdf_case(name, source, made_of, angles, brdf, **more):
    """`brdf`: function of a Pair."""
    scene, pair = wall(made_of, angles, more.pop("shape", None))
    return Case(name, source, scene, lambda: radiance(brdf(pair), pair.l), **more)


@group
def appendix_b():
    source = "Appendix B, Metal BRDF and Dielectric BRDF"
    for roughness in (0.15, 0.3, 0.5, 0.75, 1.0):
        for metallic in (0, 0.4, 1):
            for place in ("near mirror", "grazing"):
                yield brdf_case(f"brdf: {place}, roughness {roughness}, metallic {metallic}",
                                source, material(COLOR, metallic, roughness), PAIRS[place],
                                lambda p, m=metallic, r=roughness: metallic_roughness(
                                    p, COLOR, m, r))
    for place in ("mirror", "same side", "across", "coaxial"):
        for metallic in (0, 1):
            yield brdf_case(f"brdf: {place}, roughness 0.6, metallic {metallic}", source,
                            material(COLOR, metallic, 0.6), PAIRS[place],
                            lambda p, m=metallic: metallic_roughness(p, COLOR, m, 0.6))
    defaults = {"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.8, 1]}}
    yield brdf_case("brdf: metallic and roughness are 1 by default",
                    "pbrMetallicRoughness (5.22)", defaults, NEAR_MIRROR,
                    lambda p: metallic_roughness(p, (0.2, 0.4, 0.8), 1, 1))
    yield brdf_case("brdf: an empty material is a white metal", "Material (5.19)", {}, ACROSS,
                    lambda p: metallic_roughness(p, (1, 1, 1), 1, 1))


@group
def conserving():
    """The default mode: it changes diffuse light and rough metal as documented, and nothing else."""
    for roughness in (0.5, 0.8):
        for place in ("mirror", "same side", "grazing"):
            # Its curves of albedos are fits: half a percent of the diffuse light.
            yield brdf_case(f"conserving: dielectric, {place}, roughness {roughness}",
                            "libgltfx/shader/conserving.hpp; Kulla and Conty 2017",
                            material(COLOR, 0, roughness), PAIRS[place],
                            lambda p, r=roughness: conserving_dielectric(p, COLOR, r),
                            shader="conserving", near=5e-3 * LUX / math.pi)
    for roughness in (0.4, 0.7, 1):
        for place in ("mirror", "same side", "grazing"):
            yield brdf_case(f"conserving: metal, {place}, roughness {roughness}",
                            "libgltfx/shader/multiple_scattering.hpp; Turquin 2019",
                            material(COLOR, 1, roughness), PAIRS[place],
                            lambda p, r=roughness: conserving_metal(p, COLOR, r),
                            shader="conserving", near=3e-3 * LUX / math.pi)
    legal = {"sheen": {"sheenColorFactor": [0.5, 0.5, 0.5], "sheenRoughnessFactor": 0.5}}
    for name, made_of, brdf in (
            ("diffuse", lambert(COLOR), lambda p: diffuse_brdf(COLOR)),
            ("sheen alone", lambert((0, 0, 0), legal), lambda p: (0.5 * sheen_brdf(0.5, p),) * 3)):
        yield brdf_case(f"conserving: {name} is as in the text", "Appendix B", made_of, NEAR_MIRROR,
                        brdf, shader="conserving")


@group
def ior_and_specular():
    source = "KHR_materials_ior, Implementation"
    for ior in (1.0, 1.33, 1.8, 2.42, 0):
        yield brdf_case(f"ior: {ior}", source,
                        material(COLOR, 0, 0.4, extensions={"ior": {"ior": ior}}), NEAR_MIRROR,
                        lambda p, n=ior: metallic_roughness(p, COLOR, 0, 0.4, ior=n))
    yield brdf_case("ior: grazing", source,
                    material(COLOR, 0, 0.6, extensions={"ior": {"ior": 1.2}}), GRAZING,
                    lambda p: metallic_roughness(p, COLOR, 0, 0.6, ior=1.2))
    yield brdf_case("ior: metal has none", source,
                    material(COLOR, 1, 0.6, extensions={"ior": {"ior": 2.4}}), NEAR_MIRROR,
                    lambda p: metallic_roughness(p, COLOR, 1, 0.6))
    source = "KHR_materials_specular, Implementation"
    tint, bright = (0.2, 0.6, 1.0), (3.0, 30.0, 0.5)
    for name, place, factor, color, ior in (
            ("factor 0", "near mirror", 0.0, None, None),
            ("factor 0.3", "near mirror", 0.3, None, None),
            ("factor 0.3, grazing", "grazing", 0.3, None, None),
            ("color", "near mirror", 1.0, tint, None),
            ("color, grazing", "grazing", 1.0, tint, None),
            ("color above 1 ends at an F0 of 1", "near mirror", 1.0, bright, None),
            ("factor and color above 1", "mirror", 0.5, bright, None),
            ("factor, color and ior", "near mirror", 0.7, tint, 1.9),
            ("color and ior 0", "mirror", 1.0, tint, 0)):
        extensions = {"specular": {"specularFactor": factor}}
        if color:
            extensions["specular"]["specularColorFactor"] = list(color)
        if ior is not None:
            extensions["ior"] = {"ior": ior}
        dielectric = {"specular": factor, "specular_color": color or 1.0,
                      "ior": 1.5 if ior is None else ior}
        yield brdf_case(f"specular: {name}", source,
                        material(COLOR, 0, 0.4, extensions=extensions), PAIRS[place],
                        lambda p, d=dielectric: metallic_roughness(p, COLOR, 0, 0.4, **d))
    yield brdf_case("specular: half metal", source, material(
        COLOR, 0.5, 0.4, extensions={"specular": {"specularColorFactor": list(tint)}}), NEAR_MIRROR,
        lambda p: metallic_roughness(p, COLOR, 0.5, 0.4, specular_color=tint))


@group
def clearcoat():
    source = "KHR_materials_clearcoat, Layering"

    def coat(factor, roughness):
        return {"clearcoat": {"clearcoatFactor": factor, "clearcoatRoughnessFactor": roughness}}
    for factor, roughness, metallic, place in (
            (1, 0.3, 0, "near mirror"), (1, 0.5, 1, "near mirror"), (0.4, 0.3, 0, "mirror"),
            (1, 0.6, 0, "grazing"), (0.7, 1, 0.5, "across"), (1, 0.2, 1, "same side")):
        yield brdf_case(
            f"clearcoat: {factor}, roughness {roughness} on metallic {metallic}, {place}", source,
            material(COLOR, metallic, 0.7, extensions=coat(factor, roughness)), PAIRS[place],
            lambda p, f=factor, r=roughness, m=metallic: coated(
                p, metallic_roughness(p, COLOR, m, 0.7), f, r))
    for polar in (0, 60, 80):
        scene = Scene()
        scene.draw(quad(), lambert((0, 0, 0), coat(0.8, 0.5), emissiveFactor=[1, 0.5, 0.25]))
        scene.seen_from(direction(polar))
        weight = coat_weight(math.cos(math.radians(polar)), 0.8)
        yield Case(f"clearcoat: darkens emission at {polar} degrees",
                   "KHR_materials_clearcoat, Emission", scene,
                   scaled(1 - weight, (1.0, 0.5, 0.25)))


@group
def sheen():
    source = "KHR_materials_sheen, Albedo-scaling technique"
    for color, roughness, place in (
            ((1, 1, 1), 0.3, "near mirror"), ((1, 1, 1), 0.6, "same side"),
            ((0.8, 0.4, 0.1), 1.0, "across"), ((0.3, 0.6, 0.9), 0.5, "grazing"),
            ((0.2, 0.2, 0.5), 0.8, "coaxial")):
        extension = {"sheen": {"sheenColorFactor": list(color), "sheenRoughnessFactor": roughness}}
        yield brdf_case(f"sheen: alone, {color}, roughness {roughness}, {place}",
                        "KHR_materials_sheen, Sheen visibility", lambert((0, 0, 0), extension),
                        PAIRS[place],
                        lambda p, c=color, r=roughness: scaled(sheen_brdf(r, p), c))
        # A table of albedos that renderers keep has some 1e-3 of error.
        yield brdf_case(f"sheen: on a diffuse wall, {color}, roughness {roughness}, {place}",
                        source, lambert(COLOR, extension), PAIRS[place],
                        lambda p, c=color, r=roughness: with_sheen(p, diffuse_brdf(COLOR), c, r),
                        near=1e-3 * LUX / math.pi)
    extension = {"sheen": {"sheenColorFactor": [0.5, 0.7, 0.9], "sheenRoughnessFactor": 0.4},
                 "clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.5}}
    yield brdf_case("sheen: below a clearcoat", "KHR_materials_sheen, Sheen",
                    lambert((0, 0, 0), extension), NEAR_MIRROR,
                    lambda p: coated(p, scaled(sheen_brdf(0.4, p), (0.5, 0.7, 0.9)), 1, 0.5))


@group
def anisotropy():
    shape = quad().having(TANGENT=[(1, 0, 0, 1)] * 4)
    for strength, rotation, roughness, place in (
            (0, 0, 0.4, "near mirror"), (0.5, 0, 0.4, "near mirror"), (1, 0, 0.4, "near mirror"),
            (0.7, 1.2, 0.5, "across"), (0.7, -0.4, 0.3, "mirror"), (0.9, 1.57, 0.6, "coaxial"),
            (0.6, 3.0, 0.5, "same side")):
        extension = {"anisotropy": {"anisotropyStrength": strength,
                                    "anisotropyRotation": rotation}}
        for metallic in (0, 1):
            def brdf(p, s=strength, t=rotation, r=roughness, m=metallic):
                specular = anisotropic_brdf(p, r, s, t)
                dielectric = layered(dielectric_fresnel(p.v_h), diffuse_brdf(COLOR), specular)
                return mix(dielectric, metal_brdf(COLOR, specular, p.v_h), m)
            yield brdf_case(f"anisotropy: {strength}, rotation {rotation}, roughness {roughness}, "
                            f"metallic {metallic}, {place}", "KHR_materials_anisotropy, Anisotropy",
                            material(COLOR, metallic, roughness, extensions=extension),
                            PAIRS[place], brdf, shape=shape)
    turned = quad().having(TANGENT=[(0.6, 0.8, 0, -1)] * 4)
    extension = {"anisotropy": {"anisotropyStrength": 0.8, "anisotropyRotation": 0.5}}
    # Counter-clockwise from the tangent to the bitangent, which here lies to its right.
    angle = math.atan2(0.8, 0.6) - 0.5
    yield brdf_case("anisotropy: along the tangents of the mesh, left-handed",
                    "KHR_materials_anisotropy; Meshes (3.7.2), TANGENT",
                    material(COLOR, 1, 0.4, extensions=extension), NEAR_MIRROR,
                    lambda p: metal_brdf(COLOR, anisotropic_brdf(p, 0.4, 0.8, angle), p.v_h),
                    shape=turned)


@group
def iridescence():
    source = "KHR_materials_iridescence, Iridescence Fresnel"
    for thickness, ior, strength, metallic, place in (
            (400, 1.3, 1, 0, "mirror"), (250, 1.3, 1, 1, "mirror"), (550, 1.8, 1, 0, "coaxial"),
            (800, 1.5, 0.5, 1, "near mirror"), (120, 1.33, 1, 0, "grazing"),
            (400, 2.2, 0.6, 0, "across"), (1200, 1.4, 1, 1, "same side")):
        extension = {"iridescence": {"iridescenceFactor": strength, "iridescenceIor": ior,
                                     "iridescenceThicknessMaximum": thickness}}

        def brdf(p, t=thickness, n=ior, s=strength, m=metallic):
            specular = specular_brdf(0.5**2, p)
            film = iridescent_fresnel(n, 0.04, t, p.v_h)
            plain = layered(dielectric_fresnel(p.v_h), diffuse_brdf(COLOR), specular)
            dielectric = mix(plain, layered(film, diffuse_brdf(COLOR), specular), s)
            film = iridescent_fresnel(n, COLOR, t, p.v_h)
            metal = mix(metal_brdf(COLOR, specular, p.v_h), scaled(specular, film), s)
            return mix(dielectric, metal, m)
        yield brdf_case(f"iridescence: {thickness} nm, ior {ior}, factor {strength}, metallic "
                        f"{metallic}, {place}", source,
                        material(COLOR, metallic, 0.5, extensions=extension), PAIRS[place], brdf)
    for thickness, ior in ((0, 1.3), (700, 1.0)):
        for metallic in (0, 1):
            nothing = {"iridescence": {"iridescenceFactor": 1, "iridescenceIor": ior,
                                       "iridescenceThicknessMaximum": thickness}}
            yield brdf_case(f"iridescence: {thickness} nm, ior {ior}, metallic {metallic}: no film",
                            "KHR_materials_iridescence, an optical path of no length",
                            material(COLOR, metallic, 0.5, extensions=nothing), PAIRS["mirror"],
                            lambda p, m=metallic: metallic_roughness(p, COLOR, m, 0.5))
    tint = (0.5, 1.0, 2.0)
    extensions = {"iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.5,
                                  "iridescenceThicknessMaximum": 300},
                  "specular": {"specularFactor": 0.8, "specularColorFactor": list(tint)},
                  "ior": {"ior": 2.0}}

    def with_specular(p):
        film = iridescent_fresnel(1.5, scaled(0.8 / 9, tint), 300, p.v_h)
        return layered(film, diffuse_brdf(COLOR), specular_brdf(0.5**2, p))
    yield brdf_case("iridescence: with specular and ior", "KHR_materials_iridescence, Dielectric "
                    "Base Material", material(COLOR, 0, 0.5, extensions=extensions), MIRROR,
                    with_specular)


@group
def diffuse_roughness():
    source = "KHR_materials_diffuse_roughness; Portsmouth, Kutz and Hill 2024"
    for roughness, place in ((0.3, "near mirror"), (1, "near mirror"), (1, "same side"),
                             (0.6, "grazing"), (0.8, "coaxial")):
        extension = {"diffuse_roughness": {"diffuseRoughnessFactor": roughness}}
        yield brdf_case(f"diffuse roughness: {roughness}, {place}", source,
                        lambert(COLOR, extension), PAIRS[place],
                        lambda p, r=roughness: rough_diffuse_brdf(p, COLOR, r))


@group
def specular_glossiness():
    """Where F is F0, the text and its conversions say the same: view and light in one direction, or
    materials that are only diffuse or only specular."""
    source = "KHR_materials_pbrSpecularGlossiness, Specular - Glossiness"

    def made_of(diffuse, specular, glossiness):
        return {"extensions": {"KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [*diffuse, 1], "specularFactor": list(specular),
            "glossinessFactor": glossiness}}}

    def brdf(p, diffuse, specular, glossiness):
        c_diff = scaled(1 - max(specular), diffuse)
        layer = specular_brdf((1 - glossiness)**2, p)
        return plus(diffuse_brdf(c_diff), scaled(layer, schlick(specular, p.v_h)))
    for diffuse, specular, glossiness, place in (
            (COLOR, (0.04, 0.04, 0.04), 0.4, "coaxial"), (COLOR, (0.5, 0.3, 0.1), 0.6, "coaxial"),
            ((0.2, 0.3, 0.9), (0.2, 0.6, 0.4), 0.0, "coaxial"),
            ((0, 0, 0), (0.9, 0.7, 0.3), 0.5, "near mirror"),
            ((0, 0, 0), (0.1, 0.2, 0.3), 0.3, "grazing")):
        yield brdf_case(f"specular-glossiness: {diffuse}, {specular}, {glossiness}, {place}",
                        source, made_of(diffuse, specular, glossiness), PAIRS[place],
                        lambda p, d=diffuse, s=specular, g=glossiness: brdf(p, d, s, g))


# Light from the other side.

@group
def diffuse_transmission():
    source = "KHR_materials_diffuse_transmission, Implementation"
    color = (0.2, 0.8, 0.4)
    for factor, light, view in ((0.25, 150, 0), (1, 120, 40), (0.6, 110, 70), (0.6, 40, 20),
                                (1, 30, 0)):
        extension = {"diffuse_transmission": {"diffuseTransmissionFactor": factor,
                                              "diffuseTransmissionColorFactor": list(color)}}
        scene = Scene()
        scene.draw(quad(), lambert(COLOR, extension, doubleSided=True))
        scene.seen_from(direction(view))
        toward = direction(light, 50)
        scene.sun(toward, LUX)
        seen = scaled(factor, color) if light > 90 else scaled(1 - factor, COLOR)
        yield Case(f"diffuse transmission: {factor}, light at {light}, view at {view}", source,
                   scene, radiance(diffuse_brdf(seen), toward))
    extension = {"diffuse_transmission": {"diffuseTransmissionFactor": 0.5}}
    yield brdf_case("diffuse transmission: below a specular layer",
                    "KHR_materials_diffuse_transmission, Material Structure Updates",
                    material(COLOR, 0, 0.5, extensions=extension, doubleSided=True), NEAR_MIRROR,
                    lambda p: layered(dielectric_fresnel(p.v_h), scaled(0.5, diffuse_brdf(COLOR)),
                                      specular_brdf(0.25, p)))
    extensions = {**extension, "transmission": {"transmissionFactor": 1}}
    yield brdf_case("diffuse transmission: transmission overrides it",
                    "KHR_materials_diffuse_transmission, KHR_materials_transmission",
                    lambert(COLOR, extensions, doubleSided=True), NEAR_MIRROR,
                    lambda p: (0.0, 0.0, 0.0))


@group
def translucency():
    """Drafts: the first tints both sides by the base color, later ones have their own color."""
    own = {"translucencyColorFactor": [0.3, 0.7, 0.2]}
    for draft, more, tint in (("2020-06", {}, COLOR), ("2021-01", own, (0.3, 0.7, 0.2))):
        for light in (30, 140):
            leaf = {"translucency": {"translucencyFactor": 0.7, **more}}
            scene = Scene()
            scene.draw(quad(), lambert(COLOR, leaf, doubleSided=True))
            scene.seen_from(direction(20))
            scene.sun(direction(light), LUX)
            seen = scaled(0.3, COLOR) if light < 90 else scaled(0.7, tint)
            yield Case(f"translucency: draft {draft}, light at {light}",
                       "KHR_materials_translucency", scene,
                       radiance(diffuse_brdf(seen), direction(light)))


@group
def rough_transmission():
    source = "KHR_materials_transmission, Implementation Notes"
    for factor, roughness, metallic, view, light in (
            (1, 0.5, 0, (0, 0), (165, 0)), (1, 0.7, 0, (40, 20), (135, 190)),
            (0.5, 1, 0, (20, 0), (120, 90)), (1, 0.4, 0.3, (50, 0), (140, 175))):
        v, l = direction(*view), direction(*light)
        extensions = {"transmission": {"transmissionFactor": factor},
                      "specular": {"specularFactor": 0}}
        scene = Scene()
        scene.draw(quad(), material(COLOR, metallic, roughness, extensions=extensions,
                                    doubleSided=True))
        scene.seen_from(v)
        scene.sun(l, LUX)
        weight = (1 - metallic) * factor * specular_btdf(roughness**2, v, l)
        yield Case(f"rough transmission: {factor}, roughness {roughness}, metallic {metallic}, "
                   f"view {view}, light {light}", source, scene,
                   radiance(scaled(weight, COLOR), l))
    # Below a specular layer: Fresnel's term at the facet that both directions meet.
    v, l = direction(30, 0), direction(145, 190)
    scene = Scene()
    scene.draw(quad(), material(COLOR, 0, 0.6, doubleSided=True, extensions={
        "transmission": {"transmissionFactor": 1}, "ior": {"ior": 1.8}}))
    scene.seen_from(v)
    scene.sun(l, LUX)
    h = normalize(plus(v, mirrored(l)))
    kept = 1 - dielectric_fresnel(dot(v, h), ior=1.8)[0]
    yield Case("rough transmission: below a specular layer", source, scene,
               radiance(scaled(kept * specular_btdf(0.36, v, l), COLOR), l))


@group
def emission():
    source = "KHR_materials_emissive_strength"
    for strength in (0.5, 1, 20):
        scene = Scene()
        scene.draw(quad(), lambert((0, 0, 0), {"emissive_strength": {"emissiveStrength": strength}},
                                   emissiveFactor=[0.25, 0.5, 1]))
        scene.seen_from(direction(50))
        yield Case(f"emission: strength {strength}", source, scene,
                   scaled(strength, (0.25, 0.5, 1.0)))
    scene = Scene()
    scene.draw(quad(), lambert(COLOR, emissiveFactor=[0.1, 0.2, 0.3]))
    scene.seen_from(direction(20))
    scene.sun(direction(60), LUX)
    yield Case("emission: beside reflected light", "Additional Textures (3.9.3)", scene,
               plus((0.1, 0.2, 0.3), radiance(diffuse_brdf(COLOR), direction(60))))
    scene = Scene()
    scene.draw(quad(), lamp((1, 1, 1)), rotation=[0, 1, 0, 0])
    scene.seen_from()
    yield Case("emission: not from a back that is culled", "Double Sided (3.9.5)", scene, (0, 0, 0))

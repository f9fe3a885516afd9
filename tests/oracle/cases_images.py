# SPDX-License-Identifier: Apache-2.0
"""Textures, vertex colors and coverage at a point."""
import copy
import math

from brdf import (Pair, anisotropic_brdf, coated, diffuse_brdf, distribution, iridescent_fresnel,
                  metal_brdf, metallic_roughness, product, scaled, sheen_brdf, specular_brdf,
                  specular_btdf, visibility)
from case import Case, group
from cases_lights import lambert_under
from cases_materials import LUX, NEAR_MIRROR, radiance
from pictures import png
from scene import NO_SPECULAR, Scene, lambert, lamp, material, quad
from vectors import cross, direction, dot, normalize, plus, times

NEAREST = {"magFilter": 9728, "minFilter": 9728}
LINEAR = {"magFilter": 9729, "minFilter": 9729}
CLAMP, MIRROR, REPEAT = 33071, 33648, 10497
COLOR = (0.9, 0.5, 0.1)


def decoded(byte):
    """sRGB (IEC 61966-2-1)."""
    c = byte / 255
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055)**2.4


def srgb(texel):
    return tuple(decoded(byte) for byte in texel[:3])


def texel(column, row):
    """Of a table in which no two texels are alike."""
    return (20 + 60 * column, 250 - 70 * row, 5 + 31 * column + 17 * row, 255)


TABLE = [[texel(column, row) for column in range(4)] for row in range(4)]


def point_of(u, v):
    """Where a quad has these texture coordinates."""
    return (2 * u - 1, 1 - 2 * v, 0)


def shown_texel(u, v, sampler, rows=None, info=None, shape=None):
    """A texture on an unlit quad, seen at a point."""
    scene = Scene()
    index = scene.texture(png(rows or TABLE), **sampler)
    made_of = material(extensions={"unlit": {}})
    made_of["pbrMetallicRoughness"]["baseColorTexture"] = {"index": index, **(info or {})}
    scene.draw(shape or quad(), made_of)
    scene.seen_from(at=point_of(u, v))
    return scene


@group
def texels():
    for column, row in ((0, 0), (3, 0), (1, 2), (2, 3)):
        scene = shown_texel((column + 0.5) / 4, (row + 0.5) / 4, NEAREST)
        yield Case(f"texture: texel {column}, {row}", "Textures (3.8); sRGB", scene,
                   srgb(texel(column, row)))
    for byte in (0, 1, 10, 11, 64, 188, 255):
        scene = shown_texel(0.5, 0.5, NEAREST, [[(byte, 255 - byte, byte)]])
        yield Case(f"texture: sRGB {byte}", "IEC 61966-2-1", scene, srgb((byte, 255 - byte, byte)))
    scene = shown_texel(0.5, 0.5, NEAREST, [[(99,)]])
    yield Case("texture: grey PNG", "Images (3.8.3); ISO/IEC 15948", scene, (decoded(99),) * 3)
    # Between texels: decoded first, then interpolated.
    for u, v in ((0.5, 0.375), (0.45, 0.625), (0.3, 0.7)):
        x, y = 4 * u - 0.5, 4 * v - 0.5
        column, row = int(x), int(y)
        fx, fy = x - column, y - row
        parts = [times((fx if i else 1 - fx) * (fy if j else 1 - fy),
                       srgb(texel(column + i, row + j))) for i in (0, 1) for j in (0, 1)]
        yield Case(f"texture: linear at {u}, {v}", "Filtering (3.8.4.2); Materials (3.9.2)",
                   shown_texel(u, v, LINEAR), plus(*parts))
    edge = plus(times(0.6, srgb(texel(3, 0))), times(0.4, srgb(texel(0, 0))))
    yield Case("texture: linear across the edge of a repeated image", "Wrapping (3.8.4.3)",
               shown_texel(0.975, 0.125, LINEAR), edge)


@group
def wrapping():
    def around(index, mode):
        if mode == CLAMP:
            return min(max(index, 0), 3)
        folded = index % 8
        return index % 4 if mode == REPEAT else min(folded, 7 - folded)
    for column, row, s, t in ((5, 1, REPEAT, REPEAT), (-1, -2, REPEAT, REPEAT),
                              (6, -3, CLAMP, CLAMP), (5, -2, MIRROR, MIRROR),
                              (9, 10, MIRROR, CLAMP)):
        u, v = (column + 0.5) / 4, (row + 0.5) / 4
        flat = quad().having(TEXCOORD_0=[(u, v)] * 4)
        scene = shown_texel(0.5, 0.5, {**NEAREST, "wrapS": s, "wrapT": t}, shape=flat)
        yield Case(f"wrapping: {column}, {row} with {s}, {t}", "Wrapping (3.8.4.3)", scene,
                   srgb(texel(around(column, s), around(row, t))))


def transformed(uv, offset, rotation, scale):
    """Scaled, then turned counter-clockwise in a picture whose v points down, then moved. The text
    says so in words and by its example of the lower left quadrant; its GLSL, read column by column,
    turns the other way."""
    x, y = scale[0] * uv[0], scale[1] * uv[1]
    c, s = math.cos(rotation), math.sin(rotation)
    return c * x + s * y + offset[0], -s * x + c * y + offset[1]


@group
def texture_transform():
    for offset, rotation, scale in (((0.25, 0), 0, (1, 1)), ((0, 0), 0, (2, 0.5)),
                                    ((0, 1), math.pi / 2, (0.5, 0.5)),
                                    ((0.1, 0.3), 0.4, (1.5, 0.7)), ((0, 1), 0, (1, -1)),
                                    ((-0.7, 0.2), -2.0, (0.6, 1.1))):
        info = {"extensions": {"KHR_texture_transform": {
            "offset": list(offset), "rotation": rotation, "scale": list(scale)}}}
        u, v = transformed((0.6, 0.3), offset, rotation, scale)
        yield Case(f"texture transform: {offset}, {rotation:.3g}, {scale}",
                   "KHR_texture_transform, glTF Schema Updates",
                   shown_texel(0.6, 0.3, NEAREST, info=info),
                   srgb(texel(math.floor(4 * u) % 4, math.floor(4 * v) % 4)))
    second = quad().having(TEXCOORD_1=[(0.6, 0.4)] * 4)
    yield Case("texture transform: texCoord overrides that of the texture",
               "KHR_texture_transform, glTF Schema Updates",
               shown_texel(0.1, 0.1, NEAREST, shape=second, info={
                   "texCoord": 0, "extensions": {"KHR_texture_transform": {"texCoord": 1}}}),
               srgb(texel(2, 1)))
    yield Case("texture: second set of coordinates", "Materials, textureInfo (5.30)",
               shown_texel(0.1, 0.1, NEAREST, shape=second, info={"texCoord": 1}),
               srgb(texel(2, 1)))


# One texel for a whole wall, so that each slot is tested separately.

BYTES = (200, 120, 60, 150)
R, G, B, A = (byte / 255 for byte in BYTES)


def slotted(base, place, slot, texel_bytes=BYTES, shape=None, view=None, light=None, **info):
    """(scene, Pair) of a wall with that material and one texture in it. `place`: names on the way
    to the object that has the slot."""
    scene = Scene()
    owner = base = copy.deepcopy(base)
    for name in place:
        owner = owner.setdefault(name, {})
    owner[slot] = {"index": scene.texture(png([[texel_bytes]]), **NEAREST), **info}
    view, light = view or direction(*NEAR_MIRROR[0]), light or direction(*NEAR_MIRROR[1])
    scene.draw(shape or quad(), base)
    scene.seen_from(view)
    scene.sun(light, LUX)
    return scene, Pair(view, light)


PBR = ("pbrMetallicRoughness",)


def extension(name):
    return ("extensions", f"KHR_materials_{name}")


@group
def slots():
    def case(name, source, base, place, slot, brdf, **more):
        scene, pair = slotted(base, place, slot, **more)
        return Case(f"slot: {name}", source, scene, lambda: radiance(brdf(pair), pair.l))
    yield case("base color times factor", "Metallic-Roughness Material (3.9.2)", lambert(COLOR),
               PBR, "baseColorTexture", lambda p: diffuse_brdf(product(COLOR, srgb(BYTES))))
    yield case("roughness is green, metallic is blue", "Metallic-Roughness Material (3.9.2)",
               material(COLOR, 0.9, 0.8), PBR, "metallicRoughnessTexture",
               lambda p: metallic_roughness(p, COLOR, 0.9 * B, 0.8 * G))
    yield case("occlusion leaves direct light alone", "Additional Textures (3.9.3)",
               material(COLOR, 0, 0.5), (), "occlusionTexture",
               lambda p: metallic_roughness(p, COLOR, 0, 0.5), texel_bytes=(0, 0, 0))
    yield case("specular factor is alpha", "KHR_materials_specular", material(COLOR, 0, 0.4),
               extension("specular"), "specularTexture",
               lambda p: metallic_roughness(p, COLOR, 0, 0.4, specular=A))
    yield case("specular color", "KHR_materials_specular", material(COLOR, 0, 0.4, extensions={
        "specular": {"specularColorFactor": [4, 3, 2]}}), extension("specular"),
        "specularColorTexture", lambda p: metallic_roughness(
            p, COLOR, 0, 0.4, specular_color=product((4, 3, 2), srgb(BYTES))))
    coat = {"clearcoat": {"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.7}}
    yield case("clearcoat is red", "KHR_materials_clearcoat", lambert(COLOR, coat),
               extension("clearcoat"), "clearcoatTexture",
               lambda p: coated(p, diffuse_brdf(COLOR), 0.8 * R, 0.7))
    yield case("clearcoat roughness is green", "KHR_materials_clearcoat", lambert(COLOR, coat),
               extension("clearcoat"), "clearcoatRoughnessTexture",
               lambda p: coated(p, diffuse_brdf(COLOR), 0.8, 0.7 * G))
    cloth = {"sheen": {"sheenColorFactor": [0.9, 0.8, 0.7], "sheenRoughnessFactor": 0.8}}
    yield case("sheen color", "KHR_materials_sheen", lambert((0, 0, 0), cloth), extension("sheen"),
               "sheenColorTexture", lambda p: scaled(
                   sheen_brdf(0.8, p), product((0.9, 0.8, 0.7), srgb(BYTES))))
    yield case("sheen roughness is alpha", "KHR_materials_sheen", lambert((0, 0, 0), cloth),
               extension("sheen"), "sheenRoughnessTexture",
               lambda p: scaled(sheen_brdf(0.8 * A, p), (0.9, 0.8, 0.7)))
    film = {"iridescence": {"iridescenceFactor": 0.9, "iridescenceThicknessMinimum": 200,
                            "iridescenceThicknessMaximum": 700}}

    def metal_film(p, strength, thickness):
        specular = specular_brdf(0.25, p)
        return plus(scaled(1 - strength, metal_brdf(COLOR, specular, p.v_h)), scaled(
            strength * specular, iridescent_fresnel(1.3, COLOR, thickness, p.v_h)))
    yield case("iridescence is red", "KHR_materials_iridescence", material(
        COLOR, 1, 0.5, extensions=film), extension("iridescence"), "iridescenceTexture",
        lambda p: metal_film(p, 0.9 * R, 700))
    yield case("iridescence thickness is green", "KHR_materials_iridescence", material(
        COLOR, 1, 0.5, extensions=film), extension("iridescence"), "iridescenceThicknessTexture",
        lambda p: metal_film(p, 0.9, 200 + 500 * G))
    through = {"view": direction(10), "light": direction(150, 200)}
    yield case("transmission is red", "KHR_materials_transmission", material(
        COLOR, 0, 0.7, doubleSided=True, extensions={
            **NO_SPECULAR, "transmission": {"transmissionFactor": 0.9}}),
        extension("transmission"), "transmissionTexture", lambda p: scaled(
            0.9 * R * specular_btdf(0.49, p.v, p.l), COLOR), **through)
    leaf = {"diffuse_transmission": {"diffuseTransmissionFactor": 0.8}}
    yield case("diffuse transmission is alpha", "KHR_materials_diffuse_transmission",
               lambert(COLOR, leaf, doubleSided=True), extension("diffuse_transmission"),
               "diffuseTransmissionTexture",
               lambda p: (0.8 * A / math.pi,) * 3, **through)
    yield case("diffuse transmission color", "KHR_materials_diffuse_transmission",
               lambert(COLOR, leaf, doubleSided=True), extension("diffuse_transmission"),
               "diffuseTransmissionColorTexture",
               lambda p: scaled(0.8, diffuse_brdf(srgb(BYTES))), **through)
    legacy = {"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0, 0, 0, 1], "specularFactor": [0.9, 0.6, 0.3],
        "glossinessFactor": 0.9}}
    yield case("specular and glossiness", "KHR_materials_pbrSpecularGlossiness",
               {"extensions": legacy}, ("extensions", "KHR_materials_pbrSpecularGlossiness"),
               "specularGlossinessTexture", lambda p: metal_brdf(
                   product((0.9, 0.6, 0.3), srgb(BYTES)),
                   specular_brdf((1 - 0.9 * A)**2, p), p.v_h))
    along = quad().having(TANGENT=[(1, 0, 0, 1)] * 4)
    stretched = {"anisotropy": {"anisotropyStrength": 0.9, "anisotropyRotation": 0.3}}
    angle = 0.3 + math.atan2(2 * G - 1, 2 * R - 1)
    yield case("anisotropy: direction and strength", "KHR_materials_anisotropy",
               material(COLOR, 1, 0.4, extensions=stretched), extension("anisotropy"),
               "anisotropyTexture", lambda p: metal_brdf(
                   COLOR, anisotropic_brdf(p, 0.4, 0.9 * B, angle), p.v_h), shape=along)
    scene, _ = slotted(lambert((0, 0, 0), emissiveFactor=[0.9, 0.5, 1], extensions={
        "emissive_strength": {"emissiveStrength": 3}}), (), "emissiveTexture")
    yield Case("slot: emission", "Additional Textures (3.9.3)", scene,
               scaled(3, product((0.9, 0.5, 1.0), srgb(BYTES))))


@group
def normals():
    source = "Additional Textures (3.9.3), normal"
    sun = direction(30, 100)
    for bytes_of, scale, tangent in (((128, 128, 255), 1, (1, 0, 0, 1)),
                                     ((200, 90, 220), 1, (1, 0, 0, 1)),
                                     ((200, 90, 220), 0.5, (1, 0, 0, 1)),
                                     ((60, 180, 230), 1.5, (0.6, 0.8, 0, 1)),
                                     ((60, 180, 230), 1, (0.6, 0.8, 0, -1))):
        x, y, z = (byte / 255 * 2 - 1 for byte in bytes_of)
        bitangent = times(tangent[3], cross((0, 0, 1), tangent[:3]))
        normal = normalize(plus(times(scale * x, tangent[:3]), times(scale * y, bitangent),
                                (0, 0, z)))
        scene, _ = slotted(lambert(COLOR), (), "normalTexture", bytes_of,
                           quad().having(TANGENT=[tangent] * 4), (0, 0, 1), sun, scale=scale)
        yield Case(f"normal map: {bytes_of}, scale {scale}, tangent {tangent}", source, scene,
                   lambert_under(LUX * dot(normal, sun)))
    # Of the clearcoat alone: in its frame, angles differ from those of the base.
    bytes_of = (190, 110, 225)
    shape = quad().having(TANGENT=[(1, 0, 0, 1)] * 4)
    scene, pair = slotted(lambert((0, 0, 0), {"clearcoat": {
        "clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.6}}), extension("clearcoat"),
        "clearcoatNormalTexture", bytes_of, shape, direction(40, 20), direction(35, 160))
    nc = normalize(tuple(byte / 255 * 2 - 1 for byte in bytes_of))

    def coat(p):
        weight = 0.04 + 0.96 * (1 - dot(p.v, nc))**5
        layer = visibility(0.36, dot(p.l, nc), dot(p.v, nc)) * distribution(0.36, dot(p.h, nc))
        return LUX * dot(p.l, nc) * weight * layer  # the cosine is that of the coat, too
    yield Case("normal map: of a clearcoat", "KHR_materials_clearcoat, Layering", scene,
               lambda: (coat(pair),) * 3)


@group
def vertex_colors():
    source = "Metallic-Roughness Material (3.9.2), COLOR_0"
    corners = [(1.0, 0.2, 0.4), (0.1, 0.9, 0.4), (0.5, 0.5, 0.0), (0.3, 0.6, 1.0)]

    def case(name, colors, at, expected, made_of=None):
        scene = Scene()
        scene.draw(quad().having(COLOR_0=colors), made_of or material(
            COLOR, extensions={"unlit": {}}))
        scene.seen_from(at=at)
        return Case(f"vertex color: {name}", source, scene, expected)
    # At (0.5, -0.5) in the first triangle: barycentric coordinates 1/4, 1/2 and 1/4.
    between = plus(times(0.25, corners[0]), times(0.5, corners[1]), times(0.25, corners[2]))
    yield case("interpolated floats", corners, (0.5, -0.5, 0), product(COLOR, between))
    bytes_of = [(51, 102, 204, 255)] * 4
    yield case("normalized bytes are linear", bytes_of, (0, 0, 0), product(COLOR, (0.2, 0.4, 0.8)))
    # Diffuse light follows the base color; emission does not.
    scene = Scene()
    scene.draw(quad().having(COLOR_0=[(0.5, 0.25, 0.75)] * 4),
               lambert(COLOR, emissiveFactor=[0.1, 0.2, 0.3]))
    scene.seen_from()
    scene.sun((0, 0, 1), LUX)
    yield Case("vertex color: tints reflection, not emission", source, scene,
               plus((0.1, 0.2, 0.3), lambert_under(LUX, (0.5, 0.25, 0.75))))


BEHIND = (0.25, 0.5, 0.75)


def covering(made_of, shape=None):
    """A sheet before a lamp."""
    scene = Scene()
    scene.draw(shape or quad(), made_of)
    scene.draw(quad(), lamp(BEHIND), translation=[0, 0, -1])
    scene.seen_from()
    return scene


@group
def coverage():
    source = "Alpha Coverage (3.9.4)"
    unlit = {"unlit": {}}
    for alpha, more, seen in ((0.49, {}, BEHIND), (0.5, {}, COLOR), (0.51, {}, COLOR),
                              (0.25, {"alphaCutoff": 0.25}, COLOR),
                              (0.9, {"alphaCutoff": 0.95}, BEHIND),
                              (0.0, {"alphaCutoff": 0.0}, COLOR)):
        made_of = material(COLOR, alpha=alpha, extensions=unlit, alphaMode="MASK", **more)
        yield Case(f"coverage: MASK, alpha {alpha}, {more or 'cutoff 0.5'}", source,
                   covering(made_of), seen)
    yield Case("coverage: OPAQUE has no alpha", source,
               covering(material(COLOR, alpha=0.2, extensions=unlit)), COLOR)
    for alpha in (0.0, 0.3, 0.8, 1.0):
        blended = plus(scaled(alpha, COLOR), scaled(1 - alpha, BEHIND))
        yield Case(f"coverage: BLEND, alpha {alpha}", source,
                   covering(material(COLOR, alpha=alpha, extensions=unlit, alphaMode="BLEND")),
                   blended, most=1, samples=1024, size=(8, 8))
    colors = quad().having(COLOR_0=[(1.0, 1.0, 1.0, 0.5)] * 4)
    yield Case("coverage: BLEND, factor times vertex alpha", source,
               covering(material(COLOR, alpha=0.6, extensions=unlit, alphaMode="BLEND"), colors),
               plus(scaled(0.3, COLOR), scaled(0.7, BEHIND)), most=1, samples=1024, size=(8, 8))
    for mode, seen in (("MASK", BEHIND), ("BLEND", plus(scaled(0.4, COLOR), scaled(0.6, BEHIND)))):
        made_of = material(COLOR, extensions=unlit, alphaMode=mode)
        scene = covering(made_of)
        made_of["pbrMetallicRoughness"]["baseColorTexture"] = {
            "index": scene.texture(png([[(255, 255, 255, 102)]]), **NEAREST)}
        yield Case(f"coverage: {mode}, alpha of a texture is linear", source, scene, seen,
                   most=1, samples=1024, size=(8, 8))
    # Light passes where the surface is not.
    def under_sheet(mode):
        scene = Scene()
        scene.draw(quad(), lambert(COLOR))
        scene.draw(quad(0.2), lambert((0, 0, 0), alpha=0.4, alphaMode=mode, doubleSided=True),
                   translation=[0, 0, 0.5])
        scene.sun((0, 0, 1), LUX)
        scene.seen_from(direction(60))
        return scene

    yield Case("coverage: the shadow of a blended sheet", source, under_sheet("BLEND"),
               lambert_under(0.6 * LUX), most=LUX / math.pi, samples=1024, size=(8, 8))
    yield Case("coverage: no shadow of what is masked", source, under_sheet("MASK"),
               lambert_under(LUX))

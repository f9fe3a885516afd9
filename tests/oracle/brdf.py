# SPDX-License-Identifier: Apache-2.0
"""Formulas of the glTF specification, Appendix B, and of the material extensions, with the names
that they have there. Directions are unit vectors away from a surface whose normal is +z."""
import functools
import math

from vectors import cross, dot, each, normalize, plus, times

PI = math.pi
N = (0.0, 0.0, 1.0)


def mix(x, y, a):
    return each(lambda p, q: (1 - a) * p + a * q, x, y)


def scaled(factor, color):
    return each(lambda c: factor * c, color)


def product(*colors):
    return each(lambda *c: math.prod(c), *colors)


# Appendix B: specular and diffuse BRDF, Fresnel.

class Pair:
    """A view and a light direction on the same side, and their cosines."""

    def __init__(self, v, l):
        self.v, self.l = v, l
        self.h = normalize(plus(v, l))
        self.n_l, self.n_v, self.n_h = l[2], v[2], self.h[2]
        self.v_h = dot(v, self.h)


def distribution(alpha, n_h):
    return alpha**2 / (PI * (n_h**2 * (alpha**2 - 1) + 1)**2)


def visibility(alpha, n_l, n_v):
    def root(cosine):
        return math.sqrt(alpha**2 + (1 - alpha**2) * cosine**2)
    return 0.5 / (n_v * root(n_l) + n_l * root(n_v))


def specular_brdf(alpha, p):
    return visibility(alpha, p.n_l, p.n_v) * distribution(alpha, p.n_h)


def diffuse_brdf(color):
    return scaled(1 / PI, color)


def f0_of(ior, outside=1.0):
    """An index of 0 means infinity (KHR_materials_ior)."""
    return 1.0 if ior == 0 else ((ior - outside) / (ior + outside))**2


def schlick(f0, cosine, f90=1.0):
    return each(lambda f: f + (f90 - f) * (1 - abs(cosine))**5, f0)


def metal_brdf(base_color, specular, v_h):
    return scaled(specular, schlick(base_color, v_h))


def dielectric_fresnel(v_h, ior=1.5, specular=1.0, specular_color=1.0):
    """KHR_materials_specular with KHR_materials_ior; the defaults are Appendix B's 0.04."""
    f0 = each(lambda c: min(f0_of(ior) * c, 1.0), specular_color)
    return scaled(specular, schlick(f0, v_h))


def layered(fresnel, base, layer):
    """What fresnel_mix() of KHR_materials_specular and rgb_mix() of KHR_materials_iridescence do:
    the base has what the strongest channel of the layer leaves."""
    return plus(scaled(1 - max(fresnel), base), scaled(layer, fresnel))


def metallic_roughness(p, base_color, metallic, roughness, **dielectric):
    specular = specular_brdf(roughness**2, p)
    return mix(layered(dielectric_fresnel(p.v_h, **dielectric), diffuse_brdf(base_color), specular),
               metal_brdf(base_color, specular, p.v_h), metallic)


# KHR_materials_clearcoat.

def coat_weight(n_v, clearcoat):
    return clearcoat * (0.04 + (1 - 0.04) * (1 - abs(n_v))**5)


def coated(p, base, clearcoat, clearcoat_roughness):
    layer = specular_brdf(clearcoat_roughness**2, p)
    return mix(base, layer, coat_weight(p.n_v, clearcoat))


# KHR_materials_sheen ("Charlie", Conty and Kulla 2017).

def sheen_distribution(alpha_g, n_h):
    return (2 + 1 / alpha_g) * (1 - n_h**2)**(0.5 / alpha_g) / (2 * PI)


def sheen_lambda(cosine, alpha_g):
    m = (1 - alpha_g)**2
    a, b, c, d, e = ((1 - m) * rough + m * fine for rough, fine in (
        (21.5473, 25.3245), (3.82987, 3.32435), (0.19823, 0.16801), (-1.97760, -1.27393),
        (-4.32054, -4.85967)))

    def l(x):
        return a / (1 + b * x**c) + d * x + e
    return math.exp(l(cosine)) if cosine < 0.5 else math.exp(2 * l(0.5) - l(1 - cosine))


def sheen_brdf(sheen_roughness, p):
    alpha_g = sheen_roughness**2
    shadowing = 1 + sheen_lambda(p.n_v, alpha_g) + sheen_lambda(p.n_l, alpha_g)
    return sheen_distribution(alpha_g, p.n_h) / (shadowing * 4 * p.n_v * p.n_l)


@functools.lru_cache(maxsize=None)
def sheen_albedo(sheen_roughness, n_v):
    """E of the text: directional albedo of a white sheen."""
    return directional_albedo(lambda p: (sheen_brdf(sheen_roughness, p),), n_v)[0]


def with_sheen(p, base, sheen_color, sheen_roughness):
    strongest = max(sheen_color)
    scaling = min(1 - strongest * sheen_albedo(sheen_roughness, p.n_v),
                  1 - strongest * sheen_albedo(sheen_roughness, p.n_l))
    return plus(scaled(sheen_brdf(sheen_roughness, p), sheen_color), scaled(scaling, base))


# KHR_materials_anisotropy.

def anisotropic_brdf(p, roughness, strength, rotation=0.0):
    t = (math.cos(rotation), math.sin(rotation), 0.0)
    b = cross(N, t)
    alpha_b = roughness**2
    alpha_t = (1 - strength**2) * alpha_b + strength**2

    def stretched(direction):
        return math.hypot(alpha_t * dot(t, direction), alpha_b * dot(b, direction), direction[2])
    d = 1 / (PI * alpha_t * alpha_b * ((dot(p.h, t) / alpha_t)**2 + (dot(p.h, b) / alpha_b)**2 +
                                       p.n_h**2)**2)
    return d * 0.5 / (p.n_l * stretched(p.v) + p.n_v * stretched(p.l))


# KHR_materials_diffuse_roughness, by the model that its text names: energy-preserving Oren-Nayar
# (Portsmouth, Kutz and Hill 2024, arXiv 2410.18026), with its exact albedo.

def oren_nayar_albedo(mu, r):
    """Of white facets, without light that they scatter to each other."""
    theta, sine = math.acos(mu), math.sqrt(1 - mu**2)
    g = sine * (theta - sine * mu) + 2 / 3 * (sine / mu * (1 - sine**3) - sine)
    return (1 + r * g / PI) / (1 + (1 / 2 - 2 / (3 * PI)) * r)


def rough_diffuse_brdf(p, color, r):
    a = 1 / (1 + (1 / 2 - 2 / (3 * PI)) * r)
    s = dot(p.v, p.l) - p.n_v * p.n_l
    single = a * (1 + r * (s / max(p.n_v, p.n_l) if s > 0 else s))
    mean = a * (1 + (2 / 3 - 28 / (15 * PI)) * r)
    lost = (1 - oren_nayar_albedo(p.n_v, r)) * (1 - oren_nayar_albedo(p.n_l, r)) / (1 - mean)
    return each(lambda c: (c * single + c * c * mean / (1 - c * (1 - mean)) * lost) / PI, color)


# KHR_materials_iridescence (an approximation of Belcour and Barla 2017).

XYZ_TO_REC709 = ((3.2404542, -1.5371385, -0.4985314), (-0.9692660, 1.8760108, 0.0415560),
                 (0.0556434, -0.2040259, 1.0572252))
GAUSSIANS = ((5.4856e-13, 1.6810e+06, 4.3278e+09), (4.4201e-13, 1.7953e+06, 9.3046e+09),
             (5.2481e-13, 2.2084e+06, 6.6121e+09))
SECOND_OF_X = (9.7470e-14, 2.2399e+06, 4.5282e+09)


def sensitivity(opd, shift):
    """RGB; `opd` in nanometres, `shift` in radians for each channel."""
    phase = 2 * PI * opd * 1e-9

    def wave(gaussian, delta):
        value, position, variance = gaussian
        return (value * math.sqrt(2 * PI * variance) * math.cos(position * phase + delta) *
                math.exp(-variance * phase**2))
    xyz = [wave(gaussian, delta) for gaussian, delta in zip(GAUSSIANS, shift)]
    xyz[0] += wave(SECOND_OF_X, shift[0])
    return tuple(dot(row, xyz) / 1.0685e-7 for row in XYZ_TO_REC709)


def iridescent_fresnel(ior, base_f0, thickness, cos_theta1, outside_ior=1.0):
    cos_theta2_sq = 1 - (outside_ior / ior)**2 * (1 - cos_theta1**2)
    if cos_theta2_sq < 0:
        return (1.0, 1.0, 1.0)
    cos_theta2 = math.sqrt(cos_theta2_sq)
    r12 = schlick(f0_of(ior, outside_ior), cos_theta1)[0]
    roots = each(lambda f: math.sqrt(f + 0.0001), base_f0)
    base_ior = each(lambda root: (1 + root) / (1 - root), roots)
    r23 = schlick(each(lambda n: f0_of(n, ior), base_ior), cos_theta2)
    first = 0.0 if ior < outside_ior else PI
    phi = each(lambda n: first + (PI if n < ior else 0.0), base_ior)
    r123 = each(lambda r: min(max(r12 * r, 1e-5), 0.9999), r23)
    rs = each(lambda r, s: (1 - r12)**2 * r / (1 - s), r23, r123)
    total = each(lambda r: r12 + r, rs)
    amplitude = each(lambda r: r - (1 - r12), rs)
    for m in (1, 2):
        amplitude = each(lambda a, s: a * math.sqrt(s), amplitude, r123)
        wave = sensitivity(m * 2 * ior * thickness * cos_theta2, scaled(m, phi))
        total = plus(total, scaled(2, product(amplitude, wave)))
    return each(lambda x: max(x, 0.0), total)


# KHR_materials_transmission: thin walls, light from the other side.

def mirrored(direction):
    return (direction[0], direction[1], -direction[2])


def specular_btdf(alpha, v, l):
    """The light is behind the surface: l[2] < 0. The half vector is that of its mirror image."""
    h = normalize(plus(v, mirrored(l)))

    def smith(cosine):
        return 1 / (abs(cosine) + math.sqrt(alpha**2 + (1 - alpha**2) * cosine**2))
    return smith(l[2]) * smith(v[2]) * distribution(alpha, h[2])


# Integrals over directions.

def gauss_legendre(count, low, high):
    """(node, weight) of each."""
    result = []
    for i in range(count):
        x = math.cos(PI * (i + 0.75) / (count + 0.5))
        for _ in range(100):
            before, p, slope = 1.0, x, 1.0
            for k in range(2, count + 1):
                before, p = p, ((2 * k - 1) * x * p - (k - 1) * before) / k
            slope = count * (x * p - before) / (x * x - 1)
            step = p / slope
            x -= step
            if abs(step) < 1e-15:
                break
        result.append(((low + high) / 2 + (high - low) / 2 * x,
                       (high - low) / ((1 - x * x) * slope * slope)))
    return result


POLAR = gauss_legendre(96, 0, PI / 2)
AZIMUTH = gauss_legendre(64, 0, PI)
FEW_POLAR, FEW_AZIMUTH = gauss_legendre(24, 0, PI / 2), gauss_legendre(16, 0, PI)


def directional_albedo(brdf, n_v, fine=True):
    """The light of a white sky that comes back to a viewer: brdf(Pair) times cosine, integrated.
    The brdf is isotropic, so half of the azimuths are enough. `fine`: for roughness from 0.5 on,
    1e-9; otherwise 1e-4."""
    v = (math.sqrt(1 - n_v**2), 0.0, n_v)
    sums = None
    for polar, polar_weight in POLAR if fine else FEW_POLAR:
        ring = [0.0] * 3
        for azimuth, azimuth_weight in AZIMUTH if fine else FEW_AZIMUTH:
            l = (math.sin(polar) * math.cos(azimuth), math.sin(polar) * math.sin(azimuth),
                 math.cos(polar))
            value = brdf(Pair(v, l))
            ring = [r + azimuth_weight * x for r, x in zip(ring, value)]
        factor = 2 * polar_weight * math.sin(polar) * math.cos(polar)
        ring = times(factor, ring)
        sums = ring if sums is None else plus(sums, ring)
    return sums


# The mode "conserving", which departs from Appendix B (libgltfx/shader/conserving.hpp): diffuse light
# below a layer is scaled by s(V) s(L) / m. Here s is what the layer transmits over what the sample
# implementation lets pass, and m its mean over the lights of a grazing view or of one from the front.

@functools.lru_cache(maxsize=None)
def transmitted_share(n, alpha):
    def reflected(p):
        return scaled(specular_brdf(alpha, p), dielectric_fresnel(p.v_h))
    transmits = 1 - directional_albedo(reflected, n, fine=False)[0]
    return transmits / directional_albedo(passed_by_sample, n, fine=False)[0]


def passed_by_sample(p):
    return diffuse_brdf(each(lambda f: 1 - f, dielectric_fresnel(p.v_h)))


@functools.lru_cache(maxsize=None)
def mean_share(alpha, view):
    def shared(p):
        return scaled(transmitted_share(p.n_l, alpha), passed_by_sample(p))
    return (directional_albedo(shared, view, fine=False)[0] /
            directional_albedo(passed_by_sample, view, fine=False)[0])


def conserving_dielectric(p, base_color, roughness):
    alpha = roughness**2
    highest = max(mean_share(alpha, view) for view in (1e-3, 1 - 1e-9))
    held = transmitted_share(p.n_v, alpha) * transmitted_share(p.n_l, alpha) / highest
    return layered(dielectric_fresnel(p.v_h), scaled(held, diffuse_brdf(base_color)),
                   specular_brdf(alpha, p))


# Light that bounces between facets (libgltfx/shader/multiple_scattering.hpp): the lobe of a white
# metal is scaled by s(V) s(L), which makes its albedo 1, and what that adds has the colour of the
# series F E + F^2 E (1 - E) + ..., with the mean albedo E and the mean reflectance F.

LIGHTS = gauss_legendre(32, 0, 1)


def lobe_by_cosine(alpha, n_v):
    """The light of a white sky from each of LIGHTS."""
    v = (math.sqrt(1 - n_v**2), 0.0, n_v)
    ring = []
    for cosine, weight in LIGHTS:
        sine = math.sqrt(1 - cosine**2)
        total = sum(w * specular_brdf(alpha, Pair(v, (sine * math.cos(turn), sine * math.sin(turn),
                                                      cosine))) for turn, w in AZIMUTH)
        ring.append(2 * cosine * weight * total)
    return ring


@functools.lru_cache(maxsize=None)
def facet_scales(alpha):
    """s at LIGHTS, and the mean albedo."""
    lobe = [lobe_by_cosine(alpha, cosine) for cosine, _ in LIGHTS]
    mean = sum(2 * cosine * weight * sum(row) for (cosine, weight), row in zip(LIGHTS, lobe))
    scales = [1.0] * len(LIGHTS)
    for _ in range(40):
        scales = [math.sqrt(s / sum(a * t for a, t in zip(row, scales)))
                  for s, row in zip(scales, lobe)]
    return scales, mean


@functools.lru_cache(maxsize=None)
def facet_scale(alpha, n):
    scales, _ = facet_scales(alpha)
    return 1 / sum(a * s for a, s in zip(lobe_by_cosine(alpha, n), scales))


def conserving_metal(p, base_color, roughness):
    alpha = roughness**2
    _, mean = facet_scales(alpha)
    more = facet_scale(alpha, p.n_v) * facet_scale(alpha, p.n_l) - 1

    def bounced(f0):
        once = f0 + (1 - f0) / 21  # the mean of Schlick's curve
        return 1 + more * once * mean / (1 - once * (1 - mean))
    return product(metal_brdf(base_color, specular_brdf(alpha, p), p.v_h),
                   each(bounced, base_color))

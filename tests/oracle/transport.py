# SPDX-License-Identifier: Apache-2.0
"""Light between surfaces and in media: view factors, slabs of glass, half spaces that scatter."""
import math

from brdf import PI, gauss_legendre, schlick
from vectors import cross, dot, normalize


def polygon_irradiance(corners, normal):
    """Of a point at the origin below an even polygon of radiance 1 that lies above its horizon:
    half the sum of angles of edges times cosines of their planes (Lambert, Photometria, 1760).
    Corners counter-clockwise, seen from the point."""
    directions = [normalize(corner) for corner in corners]
    total = 0.0
    for a, b in zip(directions, directions[1:] + directions[:1]):
        total += math.acos(dot(a, b)) * dot(normal, normalize(cross(a, b)))
    return abs(total) / 2


# Glass.

def refracted(cosine, ior):
    """Snell: the cosine inside."""
    return math.sqrt(1 - (1 - cosine**2) / ior**2)


def slab_radiance(cosine, ior, transmittance, weight=1.0, tint=1.0):
    """Of a slab in white light: what its first face reflects, and what comes through between
    faces that reflect as often as they do: R + T t T / (1 - R t). Schlick's term takes the angle
    in the air on both ways (KHR_materials_volume). `transmittance` is that of one way."""
    r = weight * schlick(((ior - 1) / (ior + 1))**2, cosine)[0]
    passed = (1 - r) * tint
    return r + passed**2 * transmittance / (1 - r * transmittance)


# Media that scatter evenly. Lengths are in mean free paths, `albedo` is that of one event.

NODES = gauss_legendre(48, 0, 1)


def single_scatter_albedo(color):
    """KHR_materials_volume_scatter, Multi-Scatter Albedo."""
    root = math.sqrt(9.59217 + 41.6808 * color + 17.7126 * color**2)
    return 1 - (4.09712 + 4.20863 * color - root)**2


class HalfSpace:
    """Chandrasekhar, Radiative Transfer (1960), chapter V: the function H of isotropic
    scattering, by iteration of 1 / H(m) = sqrt(1 - w) + w / 2 integral of x H(x) / (m + x)."""

    def __init__(self, albedo):
        self.albedo = albedo
        self.h_at = [1.0] * len(NODES)
        for _ in range(500):
            now = [self.h(node) for node, _ in NODES]
            change = max(abs(a - b) for a, b in zip(now, self.h_at))
            self.h_at = now
            if change < 1e-12:
                break

    def h(self, mu):
        integral = sum(w * x * h / (mu + x) for (x, w), h in zip(NODES, self.h_at))
        return 1 / (math.sqrt(1 - self.albedo) + self.albedo / 2 * integral)

    def plane_albedo(self, mu):
        """The radiance towards mu under a sky of radiance 1."""
        return 1 - math.sqrt(1 - self.albedo) * self.h(mu)

    def reflected(self, mu, mu0):
        """The radiance towards mu under parallel light of 1 lux, across it, from mu0 (the law of
        diffuse reflection)."""
        return self.albedo / (4 * PI) * mu0 / (mu + mu0) * self.h(mu) * self.h(mu0)


EULER = 0.5772156649015329


def exponential_integral(order, x):
    """E1 or E2 (Abramowitz and Stegun, 5.1)."""
    if order == 2:
        return math.exp(-x) - (x * exponential_integral(1, x) if x > 0 else 0)
    if x < 1:
        total, term = -EULER - math.log(x), -1.0
        for k in range(1, 30):
            term *= -x / k
            total += term / k
        return total
    fraction = 0.0
    for k in range(60, 0, -1):
        fraction = k / (1 + k / (x + fraction))
    return math.exp(-x) / (x + fraction)


def slab_of_medium(albedo, thickness, mu):
    """The radiance towards mu of an isotropically scattering slab between two skies of radiance 1.
    Schwarzschild and Milne: S(t) = w / 2 (integral of E1(|t - x|) S(x) + E2(t) + E2(T - t));
    the singularity is removed by the integral of E1."""
    points = gauss_legendre(40, 0, thickness)
    inside = [2 - exponential_integral(2, t) - exponential_integral(2, thickness - t)
              for t, _ in points]
    kernel = [[0.0 if t == x else w * exponential_integral(1, abs(t - x)) for x, w in points]
              for t, _ in points]
    source = [albedo] * len(points)
    for _ in range(400):
        before = source
        source = [albedo / 2 * (sum(k * (s - here) for k, s in zip(row, before)) +
                                part * here + 2 - part)
                  for row, here, part in zip(kernel, before, inside)]
        if max(abs(a - b) for a, b in zip(source, before)) < 1e-10:
            break
    seen = sum(w * s * math.exp(-t / mu) for (t, w), s in zip(points, source)) / mu
    return seen + math.exp(-thickness / mu)


def legendre(count, x):
    values = [1.0, x]
    for k in range(2, count):
        values.append(((2 * k - 1) * x * values[-1] - (k - 1) * values[-2]) / k)
    return values


def forward_slab(albedo, g, thickness, mu_seen, moments=24, layers=80):
    """The radiance towards mu_seen of a slab under a white sky, dark below, with the phase function
    of Henyey and Greenstein: sum of (2 l + 1) g^l P_l. Orders of scattering are added up; the
    source is taken as constant in each layer."""
    step = thickness / layers
    half = gauss_legendre(12, 0, 1)
    rays = [(sign * mu, weight) for mu, weight in half for sign in (1, -1)]  # 1: upwards
    poly = {mu: legendre(moments, mu) for mu, _ in rays}
    gains = [albedo / 2 * (2 * k + 1) * g**k for k in range(moments)]

    def through(source_of, mu, entering):
        """The mean radiance in each layer, and what leaves the last."""
        passed = math.exp(-step / abs(mu))
        mean = (1 - passed) * abs(mu) / step
        radiance, means = entering, [0.0] * layers
        for layer in (range(layers) if mu < 0 else reversed(range(layers))):
            source = source_of[layer]
            means[layer] = source + (radiance - source) * mean
            radiance = source + (radiance - source) * passed
        return means, radiance

    sources = [[0.0] * moments for _ in range(layers)]  # by layer, times P_l of the direction
    for _ in range(200):
        fields = [[0.0] * moments for _ in range(layers)]
        for mu, weight in rays:
            along = [dot(poly[mu], source) for source in sources]
            means, _ = through(along, mu, 1.0 if mu < 0 else 0.0)
            for field, value in zip(fields, means):
                for k, p in enumerate(poly[mu]):
                    field[k] += weight * p * value
        now = [[gain * value for gain, value in zip(gains, field)] for field in fields]
        change = max(abs(a[0] - b[0]) for a, b in zip(now, sources))
        sources = now
        if change < 1e-6:
            break
    seen = legendre(moments, mu_seen)
    return through([dot(seen, source) for source in sources], mu_seen, 0.0)[1]

// SPDX-License-Identifier: Apache-2.0
/// Directions of view and light, and random directions.
#pragma once

#include <gltfx/material.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "shader/sin_cos.hpp"

namespace gltfx::shader {

using std::numbers::inv_pi;
using std::numbers::pi;

/// The measure of a value: delta lobes have values for `delta` only, all others for `solid_angle`
/// only.
enum class Measure : std::uint8_t { solid_angle, delta };

/// Kinds of lobes: a set of bits.
enum Lobes : std::uint8_t {
  kDiffuseReflect = 1,
  kDiffuseTransmit = 2,
  kSpecularReflect = 4,
  kSpecularTransmit = 8,
  kAllLobes = 15,
};

constexpr double square(double x) { return x * x; }
constexpr double pow5(double x) { return square(square(x)) * x; }

constexpr Vec3d mirrored(const Vec3d& a) { return {a.x, a.y, -a.z}; }

/// Viewer and light. The viewer is always on the side of +z.
///
/// One convention for the half vector of transmitted light: the light is mirrored at the surface
/// into the viewer's hemisphere first (H_T of KHR_materials_transmission). Only refraction has
/// another, H_TR, which specular_btdf computes.
struct Directions {
  Vec3d v;
  Vec3d l;         ///< mirrored: l.z >= 0
  bool opposite;   ///< the light is behind the surface
  double v_h = 1;  ///< cosine between viewer and half vector
  Vec3d h{0, 0, 1};
  Measure measure = Measure::solid_angle;
  std::uint8_t lobes = kAllLobes;

  Directions(const Vec3d& viewer, const Vec3d& light, Measure in = Measure::solid_angle,
             std::uint8_t asked = kAllLobes)
      : v(viewer),
        l(light.x, light.y, std::fabs(light.z)),
        opposite(light.z < 0),
        measure(in),
        lobes(asked) {
    const Vec3d sum = v + l;
    const double square_length = dot(sum, sum);
    if (square_length < 1e-300) return;  // both in the plane and opposite: no facet between them
    h = sum * (1 / std::sqrt(square_length));
    v_h = dot(v, h);
  }

  bool reflects(Lobes lobe, Measure in) const {
    return !opposite && measure == in && (lobes & lobe) != 0;
  }
  bool transmits(Lobes lobe, Measure in) const {
    return opposite && measure == in && (lobes & lobe) != 0;
  }
};

/// H_TR of KHR_materials_volume, on the viewer's side; `eta` is the IOR on the light's side over
/// that on the viewer's.
inline Vec3d refraction_half(const Directions& d, double eta) {
  const Vec3d sum = d.v + eta * mirrored(d.l);
  return normalize(sum.z > 0 ? sum : -sum);
}

/// Value and density of one direction, as multiple importance sampling needs them together.
struct Evaluation {
  Rgb f;           ///< without the cosine
  Rgb reflected;   ///< the part of `f` that is mirrored, glossy or sheen
  double pdf = 0;  ///< per steradian
};

/// A direction that a lobe samples.
struct Proposal {
  Vec3d l;
  Measure measure = Measure::solid_angle;
  bool valid = true;
};

/// The transmittance of an interface to the lobes below it. Diffuse and microfacet lobes differ in
/// half vector and in energy compensation.
struct Through {
  Rgb diffuse{1, 1, 1}, specular{1, 1, 1};
};

/// Chooses the second of two with a probability, and rescales the random number to [0, 1).
inline bool choose(double probability, double& random) {
  const bool chosen = random < probability;
  random = chosen ? random / probability : (random - probability) / (1 - probability);
  return chosen;
}

/// Around +z, density cosine / pi.
inline Vec3d cosine_hemisphere(double u, double v) {
  const double radius = std::sqrt(u);
  const SinCos turn = sin_cos_of(v);
  return {radius * turn.cosine, radius * turn.sine, std::sqrt(std::fmax(0.0, 1 - u))};
}

/// Around +z, density 1 / (2 pi).
inline Vec3d uniform_hemisphere(double u, double v) {
  const double radius = std::sqrt(std::fmax(0.0, 1 - u * u));
  const SinCos turn = sin_cos_of(v);
  return {radius * turn.cosine, radius * turn.sine, u};
}

/// One of `count` evenly spread directions.
inline Vec3d even_direction(int index, int count) {
  constexpr double kGoldenAngle = pi * (3 - 2.23606797749979);
  const double y = 1 - (2 * index + 1.0) / count;
  const double ring = std::sqrt(1 - y * y);
  const double turn = index * kGoldenAngle;
  return {ring * std::cos(turn), y, ring * std::sin(turn)};
}

}  // namespace gltfx::shader

// SPDX-License-Identifier: Apache-2.0
/// Lights: punctual ones (KHR_lights_punctual), and emissive surfaces (area lights).
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include "render/distribution.hpp"
#include "render/ray.hpp"
#include "render/scene.hpp"

namespace gltfx::render {

/// The light of a punctual light at a point.
struct Illumination {
  Vec3d direction;      ///< towards the light, unit length
  double distance = 0;  ///< metres; infinite for a directional light
  Rgb irradiance;       ///< lux on a surface that faces the light; 0: none
};

/// The illumination by one light, unoccluded.
Illumination illuminate(const Light& light, const Vec3d& point);

/// One of several lights, chosen by their illumination of the point.
struct LightChoice {
  Illumination light;
  double probability = 0;  ///< 0: no light reaches the point
};
/// Of very many lights, an evenly spaced selection is evaluated.
LightChoice choose_light(std::span<const Light> lights, const Vec3d& point, const Float2& random);

/// Whether surfaces of the material are area lights.
bool is_emissive(const SceneMaterial& material);

/// A point of an area light, seen from a lit point.
struct EmissiveTriangle {
  Vec3d position;
  Vec3d normal;     ///< of the flat triangle, towards the lit point
  Vec3d direction;  ///< from the lit point, unit length
  Rgb radiance;     ///< 0: none
  double pdf = 0;   ///< per steradian, at the lit point
};

/// Emissive triangles, sampled by power: area times emission, estimated at a few points of the
/// texture. The pdf of a triangle that is dim at these points, or beyond a million, is 0.
class Emitters {
 public:
  Emitters() = default;
  /// `dim`: luminance up to which surfaces are left to BSDF sampling.
  explicit Emitters(const Scene& scene, double dim = 0);

  bool empty() const { return shapes_.empty(); }
  /// `scene`: the same as before. `random`: uniform.
  EmissiveTriangle sample(const Scene& scene, const Vec3d& from, const Float2& random) const;
  /// The density of sample() for the hit of a ray; `cosine`: between ray and flat normal.
  double pdf(const Hit& hit, double cosine) const;

 private:
  /// Triangles of one mesh in one place, by number from `first` on.
  struct Shape {
    std::uint32_t instance = 0, mesh = 0;
    std::size_t first = 0;
  };
  void add(const Scene& scene, std::uint32_t instance, std::uint32_t mesh,
           const std::vector<float>& brightness, std::vector<float>& weights);
  double density(std::size_t number) const;  ///< of choosing a triangle

  std::vector<Shape> shapes_;  ///< by instance, then by mesh
  std::vector<float> areas_;   ///< by triangle
  PiecewiseConstant2d choice_;
};

}  // namespace gltfx::render

// SPDX-License-Identifier: Apache-2.0
/// Emissive surfaces as lights (area lights).
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>
#include <vector>

#include "bake/distribution.hpp"
#include "bake/ray.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

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
/// texture. The pdf of a triangle that is black at these points, or beyond a million, is 0.
class Emitters {
 public:
  Emitters() = default;
  explicit Emitters(const Scene& scene);

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

}  // namespace gltfx::bake

// SPDX-License-Identifier: Apache-2.0
/// Surfaces that shine, as lights that are looked for.
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>
#include <vector>

#include "bake/distribution.hpp"
#include "bake/ray.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// Whether surfaces of the material are lights.
bool shines(const SceneMaterial& material);

/// A point that shines onto another one.
struct EmissiveTriangle {
  Vec3d position;
  Vec3d normal;     ///< of the flat triangle, towards the other point
  Vec3d direction;  ///< from the other point, unit length
  Rgb radiance;     ///< 0: none
  double pdf = 0;   ///< per steradian, seen from the other point
};

/// Triangles whose material emits, taken by area times what they emit as far as a few looks at
/// their textures tell. Light that these miss, and that of meshes beyond a million triangles in
/// all, is not taken at all: its pdf is 0.
class Emitters {
 public:
  Emitters() = default;
  explicit Emitters(const Scene& scene);

  bool empty() const { return shapes_.empty(); }
  /// `scene`: the same one. `random`: even.
  EmissiveTriangle sample(const Scene& scene, const Vec3d& from, const Float2& random) const;
  /// That of sample() for what a ray has hit; `cosine`: between the ray and the flat triangle.
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
  GridDistribution choice_;
};

}  // namespace gltfx::bake

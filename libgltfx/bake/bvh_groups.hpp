// SPDX-License-Identifier: Apache-2.0
/// Which triangles of a scene are one geometry of its hierarchy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/scene.hpp"
#include "bake/stretch.hpp"

namespace gltfx::bake {

/// How rays treat triangles, which is one Embree geometry each: what needs no questions is asked
/// none.
enum class Treatment : std::uint8_t { solid, culled, holed };
constexpr std::size_t kTreatments = 3;

/// Triangles of meshes that stand in the scene once, in world space, and whose they are. A mesh of
/// many instances is a group of its own, in its own space.
struct Group {
  std::vector<std::uint32_t> instances;  ///< in order
  std::vector<std::size_t> first;        ///< triangle of each
  std::size_t triangles = 0, vertices = 0;
  bool mirrored = false;  ///< one of them, at least
};

struct Groups {
  std::array<Group, kTreatments> flat;   ///< geometry 0, 1, 2
  std::vector<std::uint32_t> instanced;  ///< instance of geometry kTreatments + i
  std::vector<int> facing;               ///< by instance: -1 where the transform mirrors
  std::size_t triangles = 0;             ///< of all instances
  double farthest = kFarthest;           ///< from where a ray may come
};

Treatment treatment_of(const SceneMaterial& material);

/// A mesh of many instances stays a mesh, as long as nothing stretches it out of all numbers.
Groups group_instances(const Scene& scene);

}  // namespace gltfx::bake

// SPDX-License-Identifier: Apache-2.0
/// Groups triangles of a scene into geometries of its hierarchy, finds repeated ones, and estimates
/// memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "render/scene.hpp"

namespace gltfx::render {

/// Embree ends the program at a ray from beyond 1.8e18.
inline constexpr double kFarthest = 5e17;

/// How rays treat triangles. Each treatment is one Embree geometry, so that filters are
/// called for the triangles that need them only.
enum class Treatment : std::uint8_t {
  solid,   ///< stops every ray
  body,    ///< a closed surface with a wall's material: solid, except for cameras inside of it
  wall,    ///< single-sided and opaque: see wall.hpp
  culled,  ///< single-sided and clear: invisible from behind
  pane,    ///< lets light straight through, single-sided or not
  holed    ///< with an alpha mode, single-sided or not
};
constexpr std::size_t kTreatments = 6;

/// Triangles of meshes that form one geometry, and their owners.
struct Group {
  struct Part {
    std::uint32_t instance = 0;  ///< meaningless in a shared group
    std::uint32_t mesh = 0;
    std::size_t first = 0;  ///< triangle in the group
  };
  std::vector<Part> parts;  ///< in order
  std::size_t triangles = 0, vertices = 0;
  bool mirrored = false;  ///< at least one of them
};
using TreatedGroups = std::array<Group, kTreatments>;

struct Groups {
  TreatedGroups flat;                    ///< in world space: geometry 0, 1, ...
  std::vector<TreatedGroups> shared;     ///< in their own space, for several instances
  std::vector<std::uint32_t> first;      ///< likewise: the first mesh of the parts
  std::vector<std::uint32_t> instanced;  ///< instance of geometry kTreatments + i
  std::vector<std::uint32_t> shape;      ///< likewise: index in `shared`
  std::vector<bool> closed;              ///< by mesh
  std::vector<std::int8_t> facing;       ///< by instance: -1 where the transform mirrors
  std::size_t triangles = 0;             ///< of all instances
  double farthest = kFarthest;           ///< farthest origin of a ray
};

/// Finds meshes that look the same to rays, whatever their color.
class Shapes {
 public:
  /// The first mesh of the instance, or that of an earlier one whose triangles are the same arrays
  /// with the same treatment. Precondition: the meshes do not change afterwards.
  std::uint32_t of(const Scene& scene, const Instance& instance);

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> by_mesh_;
  std::map<std::vector<std::uintptr_t>, std::uint32_t> known_;
};

/// Sums over the meshes of one instance.
struct ShapeSize {
  std::uint64_t triangles = 0, vertices = 0;
};

/// Bytes of the hierarchy for so many instances of a shape, with the cheaper of two methods:
/// triangles of each in world space, or one shared copy. Measured with Embree 3.13.
std::uint64_t hierarchy_bytes(const ShapeSize& shape, std::uint64_t instances);

/// Whether the mesh is the surface of a body, fronts outside: each edge of its triangles has a
/// neighbour in the opposite direction. Gaps of a few ten thousandths of its size do not count.
bool is_closed(const Mesh& mesh);

/// A shape is shared where that costs less memory, unless a transform has no inverse in floats.
/// Linear in meshes and instances.
Groups group_instances(const Scene& scene);

/// Numbers of the triangles that repeat an earlier one, corner for corner, in ascending order. A
/// hierarchy cannot separate them, so that each ray would test them all. Empty where a sample of
/// some thousand triangles has no repeats.
std::vector<std::uint32_t> find_repeats(std::span<const std::array<std::uint32_t, 3>> triangles,
                                        std::span<const Float3> points);

}  // namespace gltfx::render

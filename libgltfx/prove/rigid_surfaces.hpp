// SPDX-License-Identifier: Apache-2.0
/// The surfaces of a scene that move as a whole or not at all, whichever nodes and meshes they are
/// made of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "prove/compare_surfaces.hpp"
#include "prove/drawn_items.hpp"

namespace gltfx::prove {

/// Which nodes count.
enum class Motions : std::uint8_t {
  none,  ///< those that no animation moves
  all,
};

/// Content and tree must outlive it.
class RigidSurfaces {
 public:
  /// `kept`: by node: the other asset has it at the same place in the scene.
  RigidSurfaces(const Content& content, const NodeTree& nodes, const model::SceneRoots& scene,
                Motions motions, const std::vector<bool>& kept);

  /// How many triangles, lines and points, and whether that is few enough to be compared.
  std::uint64_t elements() const { return elements_; }
  bool fits() const { return elements_ <= kMostElements; }
  /// Where they are with these values of animated properties; at rest without.
  std::vector<SurfacePiece> pieces(const model::AnimatedValues& animated = {}) const;

  /// Whether a node of the scene draws anything but such surfaces: a light, or a mesh with joints.
  bool draws_more(std::uint32_t node) const { return in_scene_[node] != 0 && more_[node]; }

  /// Whether a pointer leads into a node, a mesh, an animation or a scene of which only such
  /// surfaces are drawn.
  bool covers(const std::optional<std::string>& pointer) const;
  /// The same of a value of a node, which may be about something else that the node draws.
  bool covers_value(const std::optional<std::string>& pointer) const;

  static constexpr std::uint64_t kMostElements = std::uint64_t{1} << 21U;

 private:
  /// Copies of a mesh that a node draws.
  struct PlacedCopies {
    std::uint32_t node = 0;
    std::optional<std::vector<model::Affine>> copies;
  };

  std::vector<bool> find_moved(Motions motions) const;
  std::vector<bool> find_joints() const;
  void find_rigid(const std::vector<bool>& moved, const std::vector<bool>& kept);
  bool is_rigid_mesh(const model::Node& node) const;
  bool says_more(json::NodeId extensions_owner, bool of_node) const;
  void count();
  bool covers_animation(std::uint32_t animation) const;

  const Content& content_;
  const NodeTree& nodes_;
  const model::SceneRoots scene_;
  std::vector<std::uint8_t> in_scene_;
  std::vector<bool> rigid_;   ///< by node: its mesh
  std::vector<bool> more_;    ///< by node: it draws anything else
  std::vector<bool> whole_;   ///< by node: all that it moves
  std::vector<bool> meshes_;  ///< by mesh: wherever it is drawn
  std::vector<PlacedCopies> placed_;
  std::uint64_t elements_ = 0;
};

}  // namespace gltfx::prove

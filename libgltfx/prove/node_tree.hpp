// SPDX-License-Identifier: Apache-2.0
/// The nodes of an asset with their parents, places and transforms.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/memory_budget.hpp"
#include "model/scene_graph.hpp"
#include "prove/content.hpp"

namespace gltfx::prove {

/// A node in double precision. As `matrix` or as parts.
struct LocalPlace {
  bool is_matrix = false;
  model::Affine affine;
  std::array<double, 4> bottom{0, 0, 0, 1};  ///< the last row of a matrix, which has no effect
  model::Vector3 translation{0, 0, 0};
  model::Quaternion rotation{0, 0, 0, 1};
  model::Vector3 scale{1, 1, 1};
  bool readable = true;
};

/// Whether two nodes are placed alike: by equal numbers, or by a matrix and its parts as single
/// precision gives them.
bool same_place(const LocalPlace& a, const LocalPlace& b);

/// For read_copies(): of all nodes of a tree, or of one pair of nodes.
constexpr std::uint64_t kCopyBytes = std::uint64_t{1} << 28U;

/// The transforms of the copies of its mesh that a node draws (EXT_mesh_gpu_instancing), in its
/// space; nothing: it draws one, or they cannot be read.
std::optional<std::vector<model::Affine>> read_copies(const Side& side, const model::Node& node,
                                                      model::MemoryBudget& budget);

/// Iterative; linear.
class NodeTree {
 public:
  explicit NodeTree(const Content& content);

  std::size_t size() const { return locals_.size(); }
  /// kNoNodeIndex for a root.
  model::NodeIndex parent(std::uint32_t node) const { return graph_.parent(node); }
  /// In the order of the lists of children; those whose parent is this one.
  const std::vector<std::uint32_t>& children(std::uint32_t node) const { return children_[node]; }
  /// In the order of the scenes, then those in no scene.
  const std::vector<std::uint32_t>& roots() const { return roots_; }
  /// All nodes, parents before their children; not those on or below a loop.
  const std::vector<std::uint32_t>& order() const { return order_; }
  const LocalPlace& local(std::uint32_t node) const { return locals_[node]; }
  const model::Affine& world(std::uint32_t node) const { return worlds_[node]; }
  /// Of the parent.
  model::Affine parent_world(std::uint32_t node) const;
  /// Hash of the path of names and ordinals from the root.
  const Hash128& place(std::uint32_t node) const { return places_[node]; }
  /// What is drawn or placed at a node and below it, in its own space; a node without a mesh is a
  /// point.
  const Content::Box& box(std::uint32_t node) const { return boxes_[node]; }
  /// Diagonal of all scenes; 0: they have no extent.
  double diagonal() const { return diagonal_; }
  /// Greatest factor by which the transform to the scene makes lengths longer.
  double greatest_scale(std::uint32_t node) const;

 private:
  void read_locals(const Content& content);
  void find_order(const Content& content);
  void find_boxes(const Content& content);

  const model::SceneGraph graph_;
  std::vector<LocalPlace> locals_;
  std::vector<model::Affine> worlds_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> roots_, order_;
  std::vector<Hash128> places_;
  std::vector<Content::Box> boxes_;
  double diagonal_ = 0;
};

/// The nodes that a scene lists.
std::vector<std::uint32_t> nodes_of_scene(const Content& content, ItemId scene);

/// How far the corners of a box are apart under two transforms, at most; not a number or infinite
/// where they are.
double farthest_corner_of(const Content::Box& box, const model::Affine& one,
                          const model::Affine& other);

/// The greatest factor of a linear part.
double greatest_scale_of(const model::Affine& place);

}  // namespace gltfx::prove

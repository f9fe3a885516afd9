// SPDX-License-Identifier: Apache-2.0
/// What of an asset is drawn: what its scenes lead to, and which nodes and animations of it show.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/pose.hpp"
#include "prove/node_tree.hpp"

namespace gltfx::prove {

/// The items of a list that JSON pointers lead to or into.
std::vector<bool> find_pointed_items(const Content& content, std::uint32_t list);
/// Whether an extension never changes a picture, as its schema states: metadata, physics, sound.
bool is_never_drawn(const Content& content, std::string_view extension);
/// Whether an extension with a schema says anything of a picture beyond how values are stored.
bool is_drawn_extension(const Content& content, std::string_view name, json::NodeId extension);
/// Whether an extension of a node only says where copies of its mesh are.
bool places_copies(std::string_view extension);
/// Whether an extension of a node leaves it as visible as it is without.
bool keeps_visible(const json::Document& document, std::string_view name, json::NodeId extension);

/// Content and tree must outlive it.
class DrawnItems {
 public:
  DrawnItems(const Content& content, const NodeTree& nodes);

  /// Whether a scene, an animation or an extension of the asset leads to it.
  bool reaches(ItemId item) const { return reached_[item.list][item.index]; }
  bool in_scene(std::uint32_t node) const { return pose_.in_scene[node] != 0; }
  /// Whether a node of a scene has a mesh, a light or another extension that is drawn.
  bool shows_itself(std::uint32_t node) const;
  /// Whether it or a node below it does, or is a joint.
  bool shows(std::uint32_t node) const { return shows_[node]; }
  /// Whether a channel moves what is drawn away from its place at rest.
  bool is_moved_by(const model::AnimationChannel& channel) const;
  /// Whether a value is part of an object that is not drawn.
  bool hides(const std::string& pointer) const;

 private:
  void find_scene();
  void find_shown();
  void find_reached();
  void reach(ItemId item, std::vector<ItemId>& open);
  bool has_drawn_extension(const model::Node& node) const;
  std::vector<float> rest_of(const model::AnimationChannel& channel) const;

  const Content& content_;
  const NodeTree& nodes_;
  const std::uint32_t list_;
  model::Pose pose_;  ///< of all scenes
  std::vector<bool> shows_;
  std::vector<std::vector<bool>> reached_;  ///< by list and index
};

}  // namespace gltfx::prove

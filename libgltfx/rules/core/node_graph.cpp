// SPDX-License-Identifier: Apache-2.0
// The scene graph as a whole: loops, nodes without use, skinned meshes in the wrong place.
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/fork.hpp"
#include "model/node.hpp"
#include "model/scene_graph.hpp"
#include "model/skin.hpp"
#include "rules/context.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"
#include "rules/fix_deletion.hpp"

namespace gltfx::validate {
namespace {

/// The scenes that list each root. Not thread-safe: caches its results.
class SkinScenes {
 public:
  SkinScenes(const model::Asset& asset, const model::SceneGraph& graph);

  /// A scene that contains the tree below `root`, but not the one below `other`. Each pair is
  /// compared once, and up to the first difference.
  std::optional<std::uint32_t> scene_without(model::NodeIndex root, model::NodeIndex other);

 private:
  using Scenes = std::vector<std::uint32_t>;  // ascending

  const Scenes& scenes_of(model::NodeIndex root) const;

  std::unordered_map<model::NodeIndex, Scenes> scenes_;
  std::unordered_map<std::uint64_t, std::optional<std::uint32_t>> known_;
};

SkinScenes::SkinScenes(const model::Asset& asset, const model::SceneGraph& graph) {
  const auto& scenes = asset.elements(model::RootArray::scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto scene = static_cast<std::uint32_t>(i);
    model::for_each_index(asset, asset.document().find(scenes[i], "nodes"), model::RootArray::nodes,
                          [&](std::uint64_t, std::optional<std::uint32_t> node, Span) {
                            // A listed node that is not a root is reported as such.
                            if (!node || !graph.is_root(*node)) return;
                            Scenes& list = scenes_[*node];
                            if (list.empty() || list.back() != scene) list.push_back(scene);
                          });
  }
}

const SkinScenes::Scenes& SkinScenes::scenes_of(model::NodeIndex root) const {
  const auto found = scenes_.find(root);
  return found == scenes_.end() ? empty_value<Scenes>() : found->second;
}

std::optional<std::uint32_t> SkinScenes::scene_without(model::NodeIndex root,
                                                       model::NodeIndex other) {
  if (root == other) return std::nullopt;
  const auto [known, fresh] =
      known_.try_emplace(std::uint64_t{root} << 32 | other, std::optional<std::uint32_t>());
  if (!fresh) return known->second;
  const Scenes& shown = scenes_of(other);
  auto at = shown.begin();
  for (const std::uint32_t scene : scenes_of(root)) {
    while (at != shown.end() && *at < scene) ++at;
    if (at == shown.end() || *at != scene) {
      known->second = scene;
      break;
    }
  }
  return known->second;
}

using model::kNoNodeIndex;
using model::NodeIndex;

class GraphCheck {
 public:
  explicit GraphCheck(const Context& context)
      : context_(context), graph_(context.graph), nodes_(context.views.nodes) {
    read_skins();
  }

  void run() {
    const Path root;
    const Path list(root, "nodes");
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const model::Node& node = nodes_[i];
      if (node.object == json::kNoNode) continue;
      const auto index = static_cast<NodeIndex>(i);
      const Path path(list, i);
      check_empty(node, index, path);
      check_loop(index, path);
      const bool checked = node.mesh || context_.deviations.consequences_are_reported;
      if (node.skin && checked) check_skinned(node, index, path);
    }
  }

 private:
  void read_skins() {
    is_joint_.assign(nodes_.size(), 0);
    for (const json::NodeId object : context_.asset.elements(model::RootArray::skins)) {
      skins_.push_back(kNoNodeIndex);
      if (object == json::kNoNode) continue;
      const model::Skin skin = model::read_skin(context_.asset, object);
      for (const NodeIndex joint : skin.joint_nodes) is_joint_[joint] = 1;
      skins_.back() = top_root(skin.joint_nodes);
    }
    if (!skins_.empty()) {
      scenes_.emplace(context_.asset, graph_);
      find_transforms();
    }
  }

  // The common root of all joints, if there is one.
  NodeIndex top_root(const std::vector<NodeIndex>& all) const {
    const auto joints = context_.deviations.common_root_starts_anew
                            ? model::joints_of_last_root(all, graph_)
                            : std::span(all);
    if (joints.empty()) return kNoNodeIndex;
    const NodeIndex root = graph_.root(joints.front());
    for (const NodeIndex joint : joints) {
      if (graph_.root(joint) != root) return kNoNodeIndex;
    }
    return root;
  }

  bool has_extension(const model::Node& node) const {
    const json::Document& document = context_.document;
    if (node.extensions == json::kNoNode || !document.is_object(node.extensions)) return false;
    return document.object_size(node.extensions) != 0;
  }

  // What nodes have since version 2.1.
  bool has_later_member(const model::Node& node) const {
    if (context_.version <= schema::kVersion2) return false;
    const json::Document& document = context_.document;
    return document.find(node.object, "externalAsset") != json::kNoNode || moves_volume(node);
  }

  // Such as the end of a joint or the eye of an avatar.
  bool is_named_by_extension(NodeIndex index) const {
    const schema::TargetArray* const nodes = context_.checked.target("/nodes");
    return nodes != nullptr && nodes->used.is_used_by_extension(index);
  }

  bool has_extras(const model::Node& node) const {
    return node.extras != json::kNoNode && context_.document.kind(node.extras) != json::Kind::null;
  }

  bool has_children(const model::Node& node) const {
    const json::Document& document = context_.document;
    if (node.children == json::kNoNode || !document.is_array(node.children)) return false;
    return document.kind(node.children) == json::Kind::number_array ||
           document.next(node.children) != node.children + 1;
  }

  void check_empty(const model::Node& node, NodeIndex index, const Path& path) {
    if (!unseen_.empty() || is_joint_[index] != 0 || node.mesh || node.camera || has_extras(node) ||
        has_children(node) || has_extension(node) || is_named_by_extension(index) ||
        has_later_member(node)) {
      return;
    }
    // The node has a reference that is broken, and reported as such.
    const bool broken = node.mesh_value != json::kNoNode || node.camera_value != json::kNoNode;
    if (broken && !context_.deviations.broken_values_are_absent) return;
    report_link(
        context_, path, node.object, Code::NODE_EMPTY,
        "The node has no children, mesh, camera, extensions or extras, and is not a joint.");
  }

  std::string label(model::RootArray array, std::uint32_t index) const {
    return object_label(context_, array, index);
  }

  void check_loop(NodeIndex index, const Path& path) {
    if (!graph_.on_loop(index)) return;
    const NodeIndex parent = graph_.parent(index);
    report_link(context_, path, nodes_[index].object, Code::NODE_LOOP,
                parent == index ? std::string("The node is its own child.")
                                : fmt::format("The node is an ancestor of its parent, {}.",
                                              label(model::RootArray::nodes, parent)));
  }

  // Whether a node or one of its ancestors has a transform: from the top down, each node once.
  void find_transforms() {
    enum State : std::uint8_t { kUnseen, kOnTheWay, kStill, kMoved };
    moved_.assign(nodes_.size(), kUnseen);
    std::vector<NodeIndex> way;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      auto at = static_cast<NodeIndex>(i);
      for (; at != kNoNodeIndex && moved_[at] == kUnseen; at = graph_.parent(at)) {
        moved_[at] = kOnTheWay;
        way.push_back(at);
      }
      bool moved = at != kNoNodeIndex && moved_[at] == kMoved;
      for (; !way.empty(); way.pop_back()) {
        moved = moved || moves(way.back());
        moved_[way.back()] = moved ? kMoved : kStill;
      }
    }
    for (std::uint8_t& state : moved_) state = state == kMoved ? 1 : 0;
  }

  bool moves(NodeIndex index) const {
    return !model::read_transform(context_.document, nodes_[index]).is_identity();
  }

  void check_skinned(const model::Node& node, NodeIndex index, const Path& path) {
    if (!moves_volume(node)) check_skinned_place(node, index, path);
    check_scenes(*node.skin, index, path, node.skin_value);
  }

  // A bounding volume follows the node and its parents, also where the mesh does not.
  bool moves_volume(const model::Node& node) const {
    return context_.version > schema::kVersion2 &&
           context_.document.find(node.object, "boundingVolume") != json::kNoNode;
  }

  void check_skinned_place(const model::Node& node, NodeIndex index, const Path& path) {
    if (!model::read_transform(context_.document, node).is_identity()) {
      report_link(context_, path, node.object, Code::NODE_SKINNED_MESH_LOCAL_TRANSFORMS,
                  "The transform of the node has no effect because its mesh is skinned.");
    }
    const NodeIndex parent = graph_.parent(index);
    if (parent != kNoNodeIndex) {
      const bool moved = moved_[parent] != 0;
      if (moved) {
        report_link(context_, path, node.object, Code::NODE_SKINNED_MESH_PARENT_TRANSFORMS,
                    "The transforms of the parents have no effect because the mesh of the node is "
                    "skinned.");
      }
      // One finding for one cause: a transform of an ancestor implies that there is an ancestor.
      if (!moved || context_.deviations.consequences_are_reported) {
        report_link(
            context_, path, node.object, Code::NODE_SKINNED_MESH_NON_ROOT,
            fmt::format(
                "The node has a skinned mesh, but is a child of {}, which does not transform it.",
                label(model::RootArray::nodes, parent)));
      }
    }
  }

  void check_scenes(std::uint32_t skin, NodeIndex index, const Path& path, json::NodeId place) {
    const NodeIndex top = skins_[skin];
    const NodeIndex own = graph_.root(index);
    if (top == kNoNodeIndex || own == kNoNodeIndex) return;
    const auto scene = scenes_->scene_without(own, top);
    if (!scene) return;
    report_link(
        context_, path, place, Code::NODE_SKIN_NO_SCENE,
        fmt::format("Scene {} contains the node, but not {}, the root of the joints of {}.", *scene,
                    label(model::RootArray::nodes, top), label(model::RootArray::skins, skin)));
  }

  const Context& context_;
  std::string_view unseen_ = unseen_user(context_);
  const model::SceneGraph& graph_;
  const std::vector<model::Node>& nodes_;
  std::vector<NodeIndex> skins_;  ///< common root of the joints, by skin
  std::vector<std::uint8_t> is_joint_;
  std::vector<std::uint8_t> moved_;  ///< the node or an ancestor has a transform
  std::optional<SkinScenes> scenes_;
};

void check_graph(const Context& context) { GraphCheck(context).run(); }

}  // namespace

const RuleGroup& node_graph_rules() {
  static constexpr LinkRule kLinkRules[] = {check_graph};
  static constexpr FixEntry kFixes[] = {{Code::NODE_EMPTY, delete_marked, FixStage::deletion}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate

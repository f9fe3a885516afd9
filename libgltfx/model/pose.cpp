// SPDX-License-Identifier: Apache-2.0
#include "model/pose.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "model/double_array.hpp"
#include "model/elements.hpp"
#include "model/fields.hpp"
#include "model/skin.hpp"

namespace gltfx::model {
namespace {

constexpr std::string_view kVisibility = "KHR_node_visibility";

Vector3 wide(const std::array<float, 3>& from) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

template <std::size_t N>
std::optional<std::array<float, N>> moved(const Properties& node, std::string_view name,
                                          const std::optional<std::array<float, N>>& written,
                                          const std::array<float, N>& absent) {
  return node.numbers<N>(name, written.value_or(absent));
}

bool has_members(const AnimatedValues& animated) { return any_below(animated, "/nodes"); }

// As written: far from the origin, single precision would round it to centimetres or metres. An
// animation replaces it by numbers of single precision.
Vector3 translation_of(const Asset& asset, const Node& node, const Transform& transform) {
  const Vector3 rounded = wide(transform.translation.value_or(std::array<float, 3>{0, 0, 0}));
  const auto written = double_array<3>(asset.document(), node.translation);
  for (std::size_t i = 0; i < 3; ++i) {
    if (!written || static_cast<double>(static_cast<float>((*written)[i])) != rounded[i]) {
      return rounded;
    }
  }
  return *written;
}

// An animated node has no matrix.
Affine local_transform(const Asset& asset, const Node& node, const AnimatedValues* animated,
                       std::size_t index) {
  Transform transform = read_transform(asset.document(), node);
  if (transform.matrix) {
    Affine affine = Affine::from_matrix(*transform.matrix);
    const auto written = double_array<16>(asset.document(), node.matrix);
    for (std::size_t i = 0; written && i < 3; ++i) affine.columns[3][i] = (*written)[12 + i];
    return affine;
  }
  if (animated != nullptr) {
    const Properties properties(asset.document(), node.object, animated,
                                fmt::format("/nodes/{}", index));
    transform.translation = moved<3>(properties, "translation", transform.translation, {0, 0, 0});
    transform.rotation = moved<4>(properties, "rotation", transform.rotation, {0, 0, 0, 1});
    transform.scale = moved<3>(properties, "scale", transform.scale, {1, 1, 1});
  }
  Quaternion rotation{0, 0, 0, 1};
  if (transform.rotation) {
    std::transform(transform.rotation->begin(), transform.rotation->end(), rotation.begin(),
                   [](float each) { return static_cast<double>(each); });
  }
  return Affine::from_parts(translation_of(asset, node, transform), rotation,
                            wide(transform.scale.value_or(std::array<float, 3>{1, 1, 1})));
}

bool is_hidden(const Asset& asset, const Node& node, const AnimatedValues* animated,
               std::size_t index) {
  if (node.extensions == json::kNoNode) return false;
  std::string pointer;
  if (animated != nullptr) pointer = fmt::format("/nodes/{}/extensions/{}", index, kVisibility);
  const json::NodeId object = object_member(asset.document(), node.extensions, kVisibility);
  if (object == json::kNoNode) return false;
  return !Properties(asset.document(), object, animated, std::move(pointer)).flag("visible", true);
}

// Walks down from nodes whose transform is known.
class Walk {
 public:
  Walk(const Asset& asset, const Views& views, const AnimatedValues& animated, Pose& pose)
      : asset_(asset),
        views_(views),
        animated_(has_members(animated) ? &animated : nullptr),
        pose_(pose),
        placed_(views.nodes.size(), 0) {}

  void run(NodeIndex root, bool in_scene) {
    enter(root, Affine(), in_scene, in_scene);
    while (!stack_.empty()) {
      const NodeIndex node = stack_.back();
      stack_.pop_back();
      const Affine world = pose_.world[node];
      for_each_index(asset_, views_.nodes[node].children, RootArray::nodes,
                     [&](std::uint64_t, std::optional<std::uint32_t> child, Span) {
                       if (child) enter(*child, world, in_scene, pose_.visible[node] != 0);
                     });
    }
  }

 private:
  void enter(NodeIndex node, const Affine& parent, bool in_scene, bool visible) {
    if (placed_[node] != 0) return;
    placed_[node] = 1;
    pose_.world[node] = parent * local_transform(asset_, views_.nodes[node], animated_, node);
    pose_.in_scene[node] = in_scene ? 1 : 0;
    const bool shown = visible && !is_hidden(asset_, views_.nodes[node], animated_, node);
    pose_.visible[node] = shown ? 1 : 0;
    stack_.push_back(node);
  }

  const Asset& asset_;
  const Views& views_;
  const AnimatedValues* animated_;
  Pose& pose_;
  std::vector<std::uint8_t> placed_;
  std::vector<NodeIndex> stack_;
};

std::vector<NodeIndex> nodes_of(const Asset& asset, std::uint32_t scene) {
  std::vector<NodeIndex> nodes;
  const json::NodeId object = asset.elements(RootArray::scenes)[scene];
  for_each_index(asset, asset.document().find(object, "nodes"), RootArray::nodes,
                 [&](std::uint64_t, std::optional<std::uint32_t> node, Span) {
                   if (node) nodes.push_back(*node);
                 });
  return nodes;
}

std::vector<NodeIndex> nodes_without_parent(const Asset& asset, const Views& views) {
  std::vector<std::uint8_t> has_parent(views.nodes.size(), 0);
  for (const Node& node : views.nodes) {
    for_each_index(asset, node.children, RootArray::nodes,
                   [&](std::uint64_t, std::optional<std::uint32_t> child, Span) {
                     if (child) has_parent[*child] = 1;
                   });
  }
  std::vector<NodeIndex> nodes;
  for (std::size_t i = 0; i < has_parent.size(); ++i) {
    const bool exists = views.nodes[i].object != json::kNoNode;
    if (has_parent[i] == 0 && exists) nodes.push_back(static_cast<NodeIndex>(i));
  }
  return nodes;
}

void apply_elements(const AnimatedValues& animated, std::string_view pointer,
                    std::vector<float>& values) {
  const std::string prefix = fmt::format("{}/", pointer);
  for (auto at = animated.lower_bound(prefix); at != animated.end(); ++at) {
    if (!at->first.starts_with(prefix)) return;
    const char* const end = at->first.data() + at->first.size();
    std::size_t index = 0;
    const auto result = std::from_chars(at->first.data() + prefix.size(), end, index);
    if (result.ptr == end && index < values.size() && at->second.size() == 1) {
      values[index] = at->second.front();
    }
  }
}

// The weights of one object, as written and animated; false when it has none.
bool read_weights(const Asset& asset, json::NodeId object, const std::string& pointer,
                  const AnimatedValues& animated, std::vector<float>& values) {
  const json::NodeId written = asset.document().find(object, "weights");
  std::vector<float> plain_values(values.size());
  const bool plain =
      read_floats(asset.document(), written, plain_values.size(), plain_values.data());
  if (plain) values = std::move(plain_values);
  const auto whole = animated.find(pointer);
  const bool moves = whole != animated.end() && whole->second.size() == values.size();
  if (moves) values = whole->second;
  if (any_below(animated, pointer)) apply_elements(animated, pointer, values);
  return plain || any_below(animated, pointer);
}

}  // namespace

SceneRoots choose_scene(const Asset& asset, const Views& views,
                        std::optional<std::uint32_t> wanted) {
  const std::size_t count = asset.count(RootArray::scenes);
  if (wanted && *wanted < count) return {nodes_of(asset, *wanted), {}, wanted};
  const json::NodeId root = asset.document().root();
  if (const auto scene = asset.index(root, "scene", RootArray::scenes)) {
    return {nodes_of(asset, *scene), {}, scene};
  }
  if (count == 0) {
    return {nodes_without_parent(asset, views),
            "The file has no scene; all of its nodes are drawn."};
  }
  const bool only = count == 1;
  return {nodes_of(asset, 0),
          only ? "" : "The file names no default scene; the first one is drawn.", 0};
}

Pose compute_pose(const Asset& asset, const Views& views, const SceneRoots& roots,
                  const AnimatedValues& animated) {
  Pose pose;
  pose.world.resize(views.nodes.size());
  pose.in_scene.assign(views.nodes.size(), 0);
  pose.visible.assign(views.nodes.size(), 0);
  Walk walk(asset, views, animated, pose);
  for (const NodeIndex root : roots.nodes) walk.run(root, true);
  for (const NodeIndex root : nodes_without_parent(asset, views)) walk.run(root, false);
  return pose;
}

Affine stored_transform(const Asset& asset, const Node& node) {
  return local_transform(asset, node, nullptr, 0);
}

std::vector<float> morph_weights(const Asset& asset, const Views& views, NodeIndex node,
                                 const AnimatedValues& animated) {
  const auto& mesh = views.nodes[node].mesh;
  if (!mesh || views.meshes[*mesh].primitives.empty()) return {};
  std::vector<float> weights(views.meshes[*mesh].primitives.front().targets.size());
  if (weights.empty()) return weights;
  std::vector<float> own = weights;
  const bool of_mesh = read_weights(asset, views.meshes[*mesh].node,
                                    fmt::format("/meshes/{}/weights", *mesh), animated, weights);
  if (of_mesh) own = weights;
  const bool of_node = read_weights(asset, views.nodes[node].object,
                                    fmt::format("/nodes/{}/weights", node), animated, own);
  std::vector<float>& chosen = of_node ? own : weights;
  for (float& weight : chosen) weight = std::isfinite(weight) ? weight : 0;
  return chosen;
}

std::vector<Affine> joint_matrices(const Asset& asset, const Views& views,
                                   const ResourceData& resources, std::uint32_t skin,
                                   const Pose& pose) {
  const Skin read = read_skin(asset, asset.elements(RootArray::skins)[skin]);
  if (read.joint_nodes.size() != read.joint_count) return {};
  std::vector<Affine> matrices;
  std::optional<ElementBlocks> inverse_bind;
  if (read.inverse_bind_matrices) {
    auto data = AccessorData::open(
        asset, views, resources, views.accessors[*read.inverse_bind_matrices], Malformed::unusable);
    const bool fits =
        data && data->format().type == ElementType::mat4 && data->count() >= read.joint_count;
    if (fits) inverse_bind.emplace(*std::move(data));
  }
  Vectors<16> element(1);
  for (std::size_t i = 0; i < read.joint_nodes.size(); ++i) {
    matrices.push_back(pose.world[read.joint_nodes[i]]);
    if (!inverse_bind) continue;
    inverse_bind->read(i, element);
    matrices.back() = matrices.back() * Affine::from_matrix(element[0]);
  }
  return matrices;
}

}  // namespace gltfx::model

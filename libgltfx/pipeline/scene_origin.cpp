// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_origin.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/double_array.hpp"
#include "model/instancing.hpp"

namespace gltfx {
namespace {

using model::Affine;
using model::NodeIndex;
using model::Vector3;

constexpr std::size_t kMostNodes = 4096;

// What a node draws, roughly.
struct RoughlyDrawn {
  Vector3 middle{};
  double size = 100;  // of unknown bounds
  double vertices = 0;
};

double length_of(const Vector3& v) { return std::sqrt(model::dot(v, v)); }

Vector3 difference(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

bool is_finite_point(const Vector3& v) {
  return std::all_of(v.begin(), v.end(), [](double each) { return std::isfinite(each); });
}

class OriginFinder {
 public:
  void add(const PlacedPart& placed, NodeIndex number) {
    const ScenePart& part = *placed.part;
    const model::Node& node = part.views.nodes[number];
    const model::Mesh& mesh = part.views.meshes[*node.mesh];
    const Affine world = placed.world(number);
    RoughlyDrawn drawn;
    Vector3 middle{};
    for (const model::Primitive& primitive : mesh.primitives) {
      const model::Attribute* positions = primitive.find(model::SemanticKind::position);
      if (positions == nullptr || !positions->accessor) continue;
      const model::Accessor& accessor = part.views.accessors[*positions->accessor];
      if (drawn.vertices == 0) take_bounds(part, accessor, world, middle, drawn.size);
      drawn.vertices += static_cast<double>(accessor.count.value_or(0));
    }
    if (!(drawn.vertices > 0)) return;
    drawn.middle = world.point(middle);
    if (const auto copy = model::place_of_copy(part.asset, part.views, part.resources, node)) {
      drawn.middle = world.point(*copy);
    }
    if (const auto joint = first_joint(part.asset, node)) {
      drawn.middle = placed.world(*joint).columns[3];
    }
    if (is_finite_point(drawn.middle) && std::isfinite(drawn.size)) drawn_.push_back(drawn);
  }

  Vector3 run() {
    constexpr double kFar = 8;  // in extents
    constexpr double kFarthest = 1e12;
    if (drawn_.empty()) return {};
    Vector3 middle{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      middle[axis] = median([axis](const RoughlyDrawn& each) { return each.middle[axis]; });
    }
    const double spread = median(
        [&middle](const RoughlyDrawn& each) { return length_of(difference(each.middle, middle)); });
    const double size = median([](const RoughlyDrawn& each) { return each.size; });
    const double reach = length_of(middle);
    return reach > kFar * (spread + size) && reach < kFarthest ? middle : Vector3{};
  }

 private:
  // Normalized integers are near 0.
  static void take_bounds(const ScenePart& part, const model::Accessor& accessor,
                          const Affine& world, Vector3& middle, double& size) {
    const json::Document& document = part.asset.document();
    const auto least = model::double_array<3>(document, accessor.min);
    const auto greatest = model::double_array<3>(document, accessor.max);
    if (!least || !greatest || accessor.format.normalized) return;
    for (std::size_t i = 0; i < 3; ++i) middle[i] = ((*least)[i] + (*greatest)[i]) / 2;
    size = length_of(world.vector(difference(*greatest, *least)));
  }

  static std::optional<NodeIndex> first_joint(const model::Asset& asset, const model::Node& node) {
    if (!node.skin) return std::nullopt;
    std::optional<NodeIndex> first;
    const json::NodeId skin = asset.elements(model::RootArray::skins)[*node.skin];
    model::for_each_index(asset, asset.document().find(skin, "joints"), model::RootArray::nodes,
                          [&](std::uint64_t, std::optional<std::uint32_t> joint, Span) {
                            if (!first) first = joint;
                          });
    return first;
  }

  // Of what draws most vertices.
  template <class Value>
  double median(const Value& value) {
    const auto less = [&value](const RoughlyDrawn& a, const RoughlyDrawn& b) {
      return value(a) < value(b);
    };
    std::sort(drawn_.begin(), drawn_.end(), less);
    double all = 0;
    for (const RoughlyDrawn& each : drawn_) all += each.vertices;
    double sum = 0;
    for (const RoughlyDrawn& each : drawn_) {
      sum += each.vertices;
      if (sum >= all / 2) return value(each);
    }
    return value(drawn_.back());
  }

  std::vector<RoughlyDrawn> drawn_;
};

// Calls `use` for each node with a mesh that counts.
template <class Use>
void for_each_drawing(const SceneTree& tree, const Use& use) {
  for (const PlacedPart& placed : tree.placed()) {
    const ScenePart& part = *placed.part;
    for (const NodeIndex node : part.drawn) {
      if (part.pose.visible[node] == 0 || !part.views.nodes[node].mesh) continue;
      if (tree.framed().empty() || tree.frames(placed, node)) use(placed, node);
    }
  }
}

}  // namespace

Vector3 find_origin(const SceneTree& tree) {
  std::size_t count = 0;
  for_each_drawing(tree, [&count](const PlacedPart&, NodeIndex) { ++count; });
  OriginFinder finder;
  const std::size_t step = count / kMostNodes + 1;
  std::size_t i = 0;
  for_each_drawing(tree, [&](const PlacedPart& placed, NodeIndex node) {
    if (i++ % step == 0) finder.add(placed, node);
  });
  return finder.run();
}

}  // namespace gltfx

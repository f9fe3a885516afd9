// SPDX-License-Identifier: Apache-2.0
#include "measure/nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "measure/take.hpp"

namespace gltfx::measure {
namespace {

using model::NodeIndex;
using model::RootArray;

constexpr double kTolerance = 1e-5;

// The lengths of the columns, sorted.
std::array<double, 3> scales_of(const model::Affine& transform) {
  std::array<double, 3> scales{};
  for (std::size_t i = 0; i < 3; ++i) {
    scales[i] = std::sqrt(model::dot(transform.columns[i], transform.columns[i]));
  }
  std::sort(scales.begin(), scales.end());
  return scales;
}

std::uint64_t children_of(const Source& source, const model::Node& node) {
  std::uint64_t count = 0;
  model::for_each_index(source.asset(), node.children, RootArray::nodes,
                        [&](std::uint64_t, const auto&, const Span&) { ++count; });
  return count;
}

// The number of nodes from the root to each node; 0 on and below a loop of parents.
std::vector<std::uint32_t> depths_of(const model::SceneGraph& graph) {
  std::vector<std::uint32_t> depths(graph.size());
  std::vector<NodeIndex> way;
  for (NodeIndex node = 0; node < graph.size(); ++node) {
    if (graph.root(node) == model::kNoNodeIndex) continue;
    NodeIndex at = node;
    for (; at != model::kNoNodeIndex && depths[at] == 0; at = graph.parent(at)) way.push_back(at);
    std::uint32_t depth = at == model::kNoNodeIndex ? 0 : depths[at];
    for (; !way.empty(); way.pop_back()) depths[way.back()] = ++depth;
  }
  return depths;
}

// A node whose element is not an object has no values.
class NodeColumns {
 public:
  explicit NodeColumns(Taking& taking) : taking_(taking) {
    if (column(Name::depth) != nullptr) depths_ = depths_of(taking.source().scene_graph());
  }

  void take(NodeIndex index) {
    const Source& source = taking_.source();
    const model::Node& node = source.views().nodes[index];
    if (node.object == json::kNoNode) return;
    set(Name::children, index, [&] { return children_of(source, node); });
    set(Name::name, index, [&] { return MeasureValue(source.asset().name(node.object)); });
    const model::Affine transform = stored_transform(source, index);
    const auto scales = scales_of(transform);
    set(Name::node_transform, index, [&] { return MeasureValue(is_identity(transform)); });
    set(Name::scale_min, index, [&] { return MeasureValue(scales.front()); });
    set(Name::scale_max, index, [&] { return MeasureValue(scales.back()); });
    set(Name::uniform_scale, index,
        [&] { return MeasureValue(scales.back() - scales.front() <= kTolerance * scales.back()); });
    set(Name::negative_scale, index, [&] { return MeasureValue(transform.determinant() < 0); });
    Column* depth = column(Name::depth);
    if (depth == nullptr) return;
    if (depths_[index] == 0) return depth->does_not_apply(index, "The node is its own ancestor.");
    depth->set(index, std::uint64_t{depths_[index]});
  }

 private:
  Column* column(Name name) { return taking_.column(MeasureScope::node, name); }
  template <class Value>
  void set(Name name, NodeIndex node, const Value& value) {
    if (Column* to = column(name)) to->set(node, value());
  }

  Taking& taking_;
  std::vector<std::uint32_t> depths_;
};

}  // namespace

bool is_identity(const model::Affine& transform) {
  const model::Affine identity;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      const double off = transform.columns[column][row] - identity.columns[column][row];
      if (!(std::abs(off) <= kTolerance)) return false;
    }
  }
  return true;
}

void take_nodes(Taking& taking) {
  NodeColumns columns(taking);
  for (NodeIndex node = 0; node < taking.count(MeasureScope::node); ++node) columns.take(node);
}

// The names of all other objects that have measures.
void take_names(Taking& taking) {
  const auto take = [&](MeasureScope scope, RootArray array) {
    Column* column = taking.column(scope, Name::name);
    if (column == nullptr) return;
    const auto& objects = taking.source().asset().elements(array);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (objects[i] == json::kNoNode) continue;
      column->set(i, MeasureValue(taking.source().asset().name(objects[i])));
    }
  };
  take(MeasureScope::mesh, RootArray::meshes);
  take(MeasureScope::material, RootArray::materials);
  take(MeasureScope::image, RootArray::images);
  take(MeasureScope::skin, RootArray::skins);
  take(MeasureScope::animation, RootArray::animations);
}

}  // namespace gltfx::measure

// SPDX-License-Identifier: Apache-2.0
#include "model/scene_graph.hpp"

namespace gltfx::model {
namespace {

enum State : std::uint8_t { kUnseen, kOnTheWay, kDone };

// Children of all nodes in one array: those of n are at [begin[n], begin[n + 1]).
struct Children {
  std::vector<std::uint32_t> begin;
  std::vector<NodeIndex> nodes;
};

Children invert(const SceneGraph& graph) {
  const auto count = static_cast<NodeIndex>(graph.size());
  Children children;
  children.begin.assign(std::size_t{count} + 1, 0);
  for (NodeIndex n = 0; n < count; ++n) {
    if (!graph.is_root(n)) ++children.begin[std::size_t{graph.parent(n)} + 1];
  }
  for (NodeIndex n = 0; n < count; ++n) children.begin[std::size_t{n} + 1] += children.begin[n];
  children.nodes.resize(children.begin[count]);
  std::vector<std::uint32_t> free_place(children.begin);
  for (NodeIndex n = 0; n < count; ++n) {
    if (!graph.is_root(n)) children.nodes[free_place[graph.parent(n)]++] = n;
  }
  return children;
}

}  // namespace

SceneGraph::SceneGraph(const Asset& asset, const std::vector<Node>& nodes) {
  const std::size_t count = nodes.size();
  parents_.assign(count, kNoNodeIndex);
  components_.assign(count, kNoNodeIndex);
  on_loop_.assign(count, 0);
  read_children(asset, nodes);
  find_components();
}

void SceneGraph::read_children(const Asset& asset, const std::vector<Node>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto parent = static_cast<NodeIndex>(i);
    for_each_index(asset, nodes[i].children, RootArray::nodes,
                   [&](std::uint64_t position, std::optional<std::uint32_t> child, Span span) {
                     if (!child) return;
                     NodeIndex& slot = parents_[*child];
                     if (slot != kNoNodeIndex) {
                       overrides_.push_back({parent, *child, slot, position, span});
                     }
                     slot = parent;
                   });
  }
}

void SceneGraph::find_components() {
  std::vector<std::uint8_t> state(size(), kUnseen);
  std::vector<NodeIndex> way;
  for (std::size_t n = 0; n < size(); ++n) climb(static_cast<NodeIndex>(n), way, state);
}

// Walks up to the top or to a known node, then sets the result for all nodes on the way.
void SceneGraph::climb(NodeIndex start, std::vector<NodeIndex>& way,
                       std::vector<std::uint8_t>& state) {
  way.clear();
  NodeIndex at = start;
  while (at != kNoNodeIndex && state[at] == kUnseen) {
    state[at] = kOnTheWay;
    way.push_back(at);
    at = parents_[at];
  }
  if (way.empty()) return;
  NodeIndex top = way.back();
  if (at != kNoNodeIndex && state[at] == kDone) top = components_[at];
  if (at != kNoNodeIndex && state[at] == kOnTheWay) {
    top = at;
    for (NodeIndex n = at; on_loop_[n] == 0; n = parents_[n]) on_loop_[n] = 1;
  }
  for (const NodeIndex n : way) {
    components_[n] = top;
    state[n] = kDone;
  }
}

Ancestry::Ancestry(const SceneGraph& graph) : enter_(graph.size(), 0), last_(graph.size(), 0) {
  const Children children = invert(graph);
  std::vector<std::uint32_t> next(children.begin.begin(), children.begin.end() - 1);
  std::vector<NodeIndex> stack;
  std::uint32_t clock = 0;
  for (NodeIndex root = 0; root < graph.size(); ++root) {
    if (!graph.is_root(root)) continue;
    stack.push_back(root);
    enter_[root] = ++clock;
    while (!stack.empty()) {
      const NodeIndex node = stack.back();
      if (next[node] == children.begin[std::size_t{node} + 1]) {
        last_[node] = clock;
        stack.pop_back();
        continue;
      }
      const NodeIndex child = children.nodes[next[node]++];
      enter_[child] = ++clock;
      stack.push_back(child);
    }
  }
}

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
// The assets that bounding volumes enclose: their nodes at rest, and their animations.
#include <algorithm>

#include "base/checked.hpp"
#include "model/skin.hpp"
#include "model/volume_search.hpp"

namespace gltfx::model {
namespace {

constexpr std::uint64_t kFreeWork = std::uint64_t{1} << 27U;
constexpr std::uint64_t kMostPairs = std::uint64_t{1} << 21U;
constexpr std::uint64_t kClipBytes = std::uint64_t{1} << 26U;

bool is_forest(const SceneGraph& graph) {
  if (!graph.overrides().empty()) return false;
  for (NodeIndex i = 0; i < graph.size(); ++i) {
    if (graph.on_loop(i)) return false;
  }
  return true;
}

}  // namespace

std::uint64_t work_for(const GeometrySource& source) {
  constexpr std::uint64_t kWorkOfByte = 64;
  return checked_mul(source.resources.buffer_bytes(), kWorkOfByte).value_or(UINT64_MAX);
}

VolumeScope::VolumeScope(const GeometrySource& from, const schema::Set& schemas, std::size_t place,
                         VolumeBudget& budget)
    : source(from),
      order(place),
      graph(from.asset, from.views.nodes),
      rest(from, graph),
      children(graph.size()) {
  for (NodeIndex i = 0; i < graph.size(); ++i) {
    if (!graph.is_root(i)) children[graph.parent(i)].push_back(i);
  }
  for (std::uint32_t i = 0; i < from.views.animations.size(); ++i) {
    clips.push_back(std::make_unique<ClipMoments>(from, schemas, i, budget.clip_bytes));
    if (clips.back()->times().empty()) clips.pop_back();
  }
}

VolumeScopes::VolumeScopes(const GeometrySource& source, const schema::Set& schemas,
                           MorePoints* more)
    : schemas_(schemas),
      more_(more),
      budget_{MemoryBudget(kClipBytes), saturating_add(kFreeWork, work_for(source)), kMostPairs},
      own_(source, schemas, 0, budget_) {}

VolumeScope* VolumeScopes::of(const MovingPart& part) {
  const auto [known, is_new] = others_.try_emplace(part.source);
  if (!is_new) return known->second.get();
  const GeometrySource& source = *part.source;
  if (!is_forest(SceneGraph(source.asset, source.views.nodes))) return nullptr;
  budget_.work = saturating_add(budget_.work, work_for(source));
  auto scope = std::make_unique<VolumeScope>(source, schemas_, others_.size(), budget_);
  const auto steps = checked_mul(scope->graph.size(), scope->clips.size() + 1);
  if (!steps || *steps >= budget_.work) return nullptr;
  budget_.work -= *steps;
  scope->moved = moved_nodes(*scope, part);
  known->second = std::move(scope);
  return known->second.get();
}

// From the roots down; a skinned mesh moves with its joints.
std::vector<NodeIndex> VolumeScopes::moved_nodes(VolumeScope& scope, const MovingPart& part) {
  const Views& views = scope.source.views;
  const auto any_clip = [&](const auto& test) {
    return std::any_of(scope.clips.begin(), scope.clips.end(), test);
  };
  std::vector<std::uint8_t> moves(scope.graph.size(), 0);
  std::vector<NodeIndex> open;
  for (NodeIndex i = 0; i < scope.graph.size(); ++i) {
    if (scope.graph.is_root(i)) open.push_back(i);
  }
  while (!open.empty()) {
    const NodeIndex node = open.back();
    open.pop_back();
    const bool with_parent = !scope.graph.is_root(node) && moves[scope.graph.parent(node)] != 0;
    if (with_parent || any_clip([&](const auto& clip) { return clip->moves(node); })) {
      moves[node] = 1;
    }
    open.insert(open.end(), scope.children[node].begin(), scope.children[node].end());
  }
  std::map<std::uint32_t, bool> skins;
  const auto skin_moves = [&](std::uint32_t skin) {
    const auto [known, is_new] = skins.try_emplace(skin);
    if (is_new) {
      const auto& joints = scope.rest.skin(skin).joints;
      known->second = std::any_of(joints.begin(), joints.end(),
                                  [&](NodeIndex joint) { return moves[joint] != 0; });
    }
    return known->second;
  };
  std::vector<NodeIndex> moved;
  for (NodeIndex i = 0; i < scope.graph.size(); ++i) {
    if (part.drawn[i] == 0) continue;
    const Node& node = views.nodes[i];
    bool complete = true;
    const bool placed = node.mesh && node.skin ? skin_moves(*node.skin) : moves[i] != 0;
    const bool morphs =
        node.mesh && any_clip([&](const auto& clip) { return clip->morphs(i, *node.mesh); });
    const bool draws = node.mesh || (placed && part.more->of(i, complete) != nullptr);
    if (draws && (placed || morphs)) moved.push_back(i);
  }
  return moved;
}

}  // namespace gltfx::model

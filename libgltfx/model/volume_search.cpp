// SPDX-License-Identifier: Apache-2.0
#include "model/volume_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/checked.hpp"
#include "model/instancing.hpp"
#include "model/volume_watchers.hpp"

namespace gltfx::model {
namespace {

constexpr std::uint64_t kCopyBytes = std::uint64_t{1} << 26U;  // of the copies of one node
constexpr double kNear = 0.01;  // of the size: how deep inside vertices are still followed

void keep_greatest(VolumeVerdict& verdict, const VolumeMiss& miss) {
  if (miss.distance > verdict.greatest.distance) verdict.greatest = miss;
}

// How far below the greatest distance others are followed: between moments they may be greater.
double margin_of(const BoundingVolume& volume) { return kNear * volume.size(); }

// The moments at which a mesh is as far outside as at none near them, the farthest ones first.
std::vector<std::pair<double, std::size_t>> peaks_of(const std::vector<double>& heights,
                                                     double least) {
  constexpr std::size_t kMostPeaks = 8;
  std::vector<std::pair<double, std::size_t>> peaks;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const bool rises = i == 0 || heights[i] > heights[i - 1];
    const bool falls = i + 1 == heights.size() || heights[i] >= heights[i + 1];
    if (rises && falls && heights[i] >= least) peaks.emplace_back(-heights[i], i);
  }
  std::sort(peaks.begin(), peaks.end());
  peaks.resize(std::min(peaks.size(), kMostPeaks));
  return peaks;
}

}  // namespace

VolumeSearch::VolumeSearch(VolumeScopes& scopes)
    : scopes_(scopes), budget_(scopes.budget()), own_{&scopes.own(), nullptr, 0, Affine()} {}

void VolumeSearch::add(NodeIndex node, const BoundingVolume& volume) {
  VolumeVerdict& verdict = verdicts_.emplace_back();
  verdict.node = node;
  verdict.at_rest.distance = verdict.greatest.distance = -margin_of(volume);
  volumes_.push_back(&volume);
  verdict.complete = collect(node, verdicts_.size() - 1);
}

bool VolumeSearch::collect(NodeIndex upper, std::size_t slot) {
  const VolumeScope& own = scopes_.own();
  bool complete = true;
  std::vector<NodeIndex> open{upper};
  while (!open.empty()) {
    const NodeIndex node = open.back();
    open.pop_back();
    if (budget_.pairs == 0) return false;
    --budget_.pairs;
    if (own.source.views.nodes[node].mesh) pairs_.push_back({slot, upper, node, true, &own_});
    MorePoints* const more = scopes_.more();
    if (more != nullptr && more->of(node, complete) != nullptr) {
      pairs_.push_back({slot, upper, node, false, &own_});
      complete = collect_moving(upper, node, slot) && complete;
    }
    open.insert(open.end(), own.children[node].begin(), own.children[node].end());
  }
  return complete;
}

// What animations of external assets move. The node that has them is at rest then.
bool VolumeSearch::collect_moving(NodeIndex upper, NodeIndex holder, std::size_t slot) {
  const auto& moving = scopes_.more()->moving(holder);
  if (moving.empty()) return true;
  VolumeScope& own = scopes_.own();
  Affine to_upper;
  for (NodeIndex at = holder; at != upper; at = own.graph.parent(at)) {
    to_upper = own.rest.local(at, {}) * to_upper;
  }
  for (const MovingPart& each : moving) {
    VolumeScope* const scope = scopes_.of(each);
    if (scope == nullptr || budget_.pairs < scope->moved.size()) return false;
    if (scope->moved.empty()) continue;
    budget_.pairs -= scope->moved.size();
    const Part& part = external_.emplace_back(Part{scope, &each, holder, to_upper * each.place});
    for (const NodeIndex node : scope->moved) {
      const bool has_mesh = scope->source.views.nodes[node].mesh.has_value();
      pairs_.push_back({slot, kNoNodeIndex, node, has_mesh, &part});
    }
  }
  return true;
}

MorePoints* VolumeSearch::more_of(const Pair& pair) const {
  return pair.is_external() ? pair.part->external->more : scopes_.more();
}

PosedMesh VolumeSearch::posed(const Pair& pair) {
  return {pair.part->scope->rest, pair.upper, pair.node};
}

// A mesh is read once for all nodes that draw it, and forgotten.
void VolumeSearch::for_each_group(const std::function<void(const Pair&, Group&)>& use) {
  const auto key_of = [](const Pair& pair) {
    const Node& node = pair.described();
    return std::tuple(pair.part->scope->order, !pair.has_mesh,
                      pair.has_mesh ? *node.mesh : pair.node,
                      pair.has_mesh && node.skin ? *node.skin + std::uint64_t{1} : 0);
  };
  std::stable_sort(pairs_.begin(), pairs_.end(),
                   [&](const Pair& a, const Pair& b) { return key_of(a) < key_of(b); });
  for (std::size_t first = 0; first < pairs_.size();) {
    std::size_t last = first;
    while (last < pairs_.size() && key_of(pairs_[last]) == key_of(pairs_[first])) ++last;
    Group group;
    prepare(std::span(pairs_).subspan(first, last - first), group);
    for (; first < last; ++first) use(pairs_[first], group);
  }
}

void VolumeSearch::prepare(std::span<const Pair> pairs, Group& group) const {
  const Pair& first = pairs.front();
  if (!first.has_mesh) {
    bool complete = true;
    group.blocks = more_of(first)->of(first.node, complete);
    return;
  }
  const VolumeScope& scope = *first.part->scope;
  const std::uint32_t index = *first.described().mesh;
  const Mesh& mesh = scope.source.views.meshes[index];
  const bool has_targets = std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                                       [](const auto& each) { return !each.targets.empty(); });
  for (std::size_t i = 0; has_targets && !group.morphs && i < pairs.size(); ++i) {
    const NodeIndex node = pairs[i].node;
    const auto weights = morph_weights(scope.source.asset, scope.source.views, node);
    group.morphs = std::any_of(weights.begin(), weights.end(), [](float w) { return w != 0; }) ||
                   std::any_of(scope.clips.begin(), scope.clips.end(),
                               [&](const auto& clip) { return clip->morphs(node, index); });
  }
  if (!group.morphs) group.bounds = stated_bounds(scope.source, mesh);
}

bool VolumeSearch::read(const Shown& shown) {
  Group& group = shown.group;
  if (group.tried || group.blocks != nullptr) return group.blocks != nullptr;
  group.tried = true;
  const GeometrySource& source = shown.pair.part->scope->source;
  MemoryBudget budget(saturating_add(std::uint64_t{1} << 28U, work_for(source)));
  const Mesh& mesh = source.views.meshes[*shown.pair.described().mesh];
  auto blocks = PointBlocks::read(source, mesh, shown.mesh.joints(), group.morphs, budget);
  if (!blocks) return false;
  budget_.work -= std::min<std::uint64_t>(budget_.work, blocks->size());
  group.blocks = &group.read.emplace(*std::move(blocks));
  return true;
}

// Nothing: the copies of the node cannot be read.
std::optional<std::vector<Affine>> VolumeSearch::copies_of(const Shown& shown) {
  if (!shown.pair.has_mesh || shown.mesh.joints() > 0) return std::vector{Affine()};
  const GeometrySource& source = shown.pair.part->scope->source;
  MemoryBudget budget(kCopyBytes);
  auto copies =
      read_instancing(source.asset, source.views, source.resources, shown.pair.described(), budget);
  if (!copies) return std::vector{Affine()};
  return copies->readable ? std::optional(std::move(copies->transforms)) : std::nullopt;
}

// Shows a mesh at one moment. False: it cannot be read, or there is too much work.
bool VolumeSearch::show(const Shown& shown, const PosedMoment& at, PointWatcher& watcher) {
  if (!shown.mesh.is_sound() || budget_.work <= shown.mesh.steps()) return false;
  budget_.work -= shown.mesh.steps();
  if (!shown.mesh.place(at, matrices_)) return true;
  const Affine frame = volumes_[shown.pair.slot]->to_frame() * shown.pair.part->to_upper;
  for (Affine& each : matrices_) each = frame * each;
  const std::vector<float> weights =
      shown.pair.has_mesh && shown.group.morphs ? shown.mesh.weights(at) : std::vector<float>();
  const auto copies = copies_of(shown);
  if (!copies) return false;
  for (const Affine& copy : *copies) {
    if (budget_.work == 0) return false;
    --budget_.work;
    std::vector<Affine> placed = matrices_;
    for (Affine& each : placed) each = each * copy;
    const Box& bounds = shown.group.bounds;
    if (!bounds.empty() && shown.mesh.joints() == 0 &&
        !watcher.wants(moved_box(placed.front(), bounds))) {
      continue;
    }
    if (!read(shown) || !shown.group.blocks->visit({placed, weights}, budget_.work, watcher)) {
      return false;
    }
  }
  return true;
}

bool VolumeSearch::show(PointWatcher& watcher, bool poses) {
  bool complete = verdicts_.front().complete;
  for_each_group([&](const Pair& pair, Group& group) {
    PosedMesh mesh = posed(pair);
    if (!pair.is_external()) complete = complete && show({pair, mesh, group}, {}, watcher);
    for (const auto& clip : pair.part->scope->clips) {
      if (!poses || !mesh.is_moved_by(*clip)) continue;
      for (std::size_t i = 0; complete && i < clip->times().size(); ++i) {
        complete = show({pair, mesh, group}, {clip.get(), i}, watcher);
      }
    }
  });
  return complete;
}

bool VolumeSearch::moves() {
  return std::any_of(pairs_.begin(), pairs_.end(), [](const Pair& pair) {
    const PosedMesh mesh = posed(pair);
    const auto& clips = pair.part->scope->clips;
    return std::any_of(clips.begin(), clips.end(),
                       [&](const auto& clip) { return mesh.is_moved_by(*clip); });
  });
}

void VolumeSearch::judge() {
  for_each_group([&](const Pair& pair, Group& group) { judge(pair, group); });
}

void VolumeSearch::judge(const Pair& pair, Group& group) {
  VolumeVerdict& verdict = verdicts_[pair.slot];
  PosedMesh mesh = posed(pair);
  const Shown shown{pair, mesh, group};
  std::vector<ClipMoments*> clips;
  for (const auto& clip : pair.part->scope->clips) {
    if (mesh.is_moved_by(*clip)) clips.push_back(clip.get());
  }
  // What does not move is only of interest outside. External assets at rest are points of their
  // own.
  const double floor = clips.empty() ? 0.0 : verdict.at_rest.distance;
  if (!pair.is_external()) {
    if (const auto miss = look(shown, {}, std::max(verdict.at_rest.distance, floor))) {
      verdict.at_rest = *miss;
      keep_greatest(verdict, *miss);
    }
  }
  for (ClipMoments* const clip : clips) {
    verdict.moves = true;
    play(shown, *clip);
  }
}

void VolumeSearch::play(const Shown& shown, ClipMoments& clip) {
  VolumeVerdict& verdict = verdicts_[shown.pair.slot];
  const double margin = margin_of(*volumes_[shown.pair.slot]);
  std::vector<double> heights(clip.times().size(), -HUGE_VAL);
  for (std::size_t i = 0; i < heights.size() && verdict.complete; ++i) {
    const auto miss = look(shown, {&clip, i}, verdict.greatest.distance - margin);
    if (!miss) continue;
    heights[i] = miss->distance;
    keep_greatest(verdict, *miss);
  }
  for (const auto& [height, moment] : peaks_of(heights, verdict.greatest.distance - margin)) {
    climb(shown, clip, moment, -height);
  }
}

// The vertex that is farthest outside at one moment, if that is more than `beyond`.
std::optional<VolumeMiss> VolumeSearch::look(const Shown& shown, const PosedMoment& at,
                                             double beyond) {
  const Pair& pair = shown.pair;
  MissWatcher watcher(*volumes_[pair.slot], beyond);
  if (!show(shown, at, watcher)) verdicts_[pair.slot].complete = false;
  if (!watcher.found()) return std::nullopt;
  VolumeMiss miss;
  miss.distance = watcher.most();
  miss.node = pair.is_external() ? pair.part->holder : pair.node;
  miss.vertex = shown.group.blocks->origin_of(*watcher.found());
  miss.reach = watcher.reach();
  if (at.clip != nullptr) {
    miss.external = pair.part->external;
    miss.animation = at.clip->animation();
    miss.time = at.time();
  }
  return miss;
}

// From a moment to the greatest distance near it.
void VolumeSearch::climb(const Shown& shown, ClipMoments& clip, std::size_t moment, double height) {
  constexpr int kSteps = 24;
  VolumeVerdict& verdict = verdicts_[shown.pair.slot];
  const std::vector<double>& times = clip.times();
  double time = times[moment];
  double step = std::max(time - times[moment > 0 ? moment - 1 : 0],
                         times[std::min(moment + 1, times.size() - 1)] - time) /
                2;
  const auto rises_at = [&](double to) {
    if (to < times.front() || to > times.back()) return false;
    const auto miss = look(shown, {&clip, moment, to}, height);
    if (!miss) return false;
    height = miss->distance;
    time = to;
    keep_greatest(verdict, *miss);
    return true;
  };
  for (int i = 0; i < kSteps && step > 0 && verdict.complete; ++i) {
    if (!rises_at(time + step) && !rises_at(time - step)) step /= 2;
  }
}

}  // namespace gltfx::model

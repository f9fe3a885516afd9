// SPDX-License-Identifier: Apache-2.0
#include "model/volume_contents.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "base/checked.hpp"
#include "model/instancing.hpp"
#include "model/posed_mesh.hpp"
#include "model/volume_watchers.hpp"

namespace gltfx::model {
namespace {

constexpr std::uint64_t kFreeWork = std::uint64_t{1} << 27U;  // boxes and vertices
constexpr std::uint64_t kWorkOfByte = 64;
constexpr std::uint64_t kMostPairs = std::uint64_t{1} << 21U;  // of volumes and nodes below
constexpr std::uint64_t kClipBytes = std::uint64_t{1} << 26U;  // transforms that are kept
constexpr std::uint64_t kCopyBytes = std::uint64_t{1} << 26U;  // of the copies of one node
constexpr double kNear = 0.01;  // of the size: how deep inside vertices are still followed

}  // namespace

double tolerance_of(const BoundingVolume& volume, const VolumeMiss& miss) {
  constexpr double kOfSize = 1e-5, kOfReach = 1.0 / (1U << 22U);
  return kOfSize * volume.size() + kOfReach * miss.reach;
}

/// What all searches need; made once.
struct VolumeContents::Shared {
  Shared(const GeometrySource& source, const schema::Set& schemas)
      : graph(source.asset, source.views.nodes), rest(source, graph), children(graph.size()) {
    const Checked worth = checked_mul(source.resources.buffer_bytes(), kWorkOfByte);
    work = saturating_add(kFreeWork, worth.value_or(UINT64_MAX));
    for (NodeIndex i = 0; i < graph.size(); ++i) {
      if (!graph.is_root(i)) children[graph.parent(i)].push_back(i);
    }
    for (std::uint32_t i = 0; i < source.views.animations.size(); ++i) {
      clips.push_back(std::make_unique<ClipMoments>(source, schemas, i, clip_bytes));
      if (clips.back()->times().empty()) clips.pop_back();
    }
  }

  const SceneGraph graph;
  RestNodes rest;
  std::vector<std::vector<NodeIndex>> children;  ///< by node
  MemoryBudget clip_bytes{kClipBytes};
  std::vector<std::unique_ptr<ClipMoments>> clips;
  std::uint64_t work = 0;  ///< that is left
  std::uint64_t pairs = kMostPairs;
};

/// A pass over some volumes.
class VolumeContents::Search {
 public:
  explicit Search(VolumeContents& of) : of_(of), source_(of.source_), shared_(of.shared()) {}

  VolumeVerdict& add(NodeIndex node, const BoundingVolume& volume) {
    VolumeVerdict& verdict = verdicts_.emplace_back();
    verdict.node = node;
    verdict.at_rest.distance = verdict.greatest.distance = -kNear * volume.size();
    volumes_.push_back(&volume);
    verdict.complete = collect(node, verdicts_.size() - 1);
    return verdict;
  }

  void judge() {
    for_each_group([&](const Pair& pair, Group& group) { judge(pair, group); });
  }
  std::vector<VolumeVerdict>& verdicts() { return verdicts_; }

  // Shows all that the one volume of the search should enclose. False: some of it is not known.
  bool show(PointWatcher& watcher, bool poses) {
    bool complete = verdicts_.front().complete;
    for_each_group([&](const Pair& pair, Group& group) {
      PosedMesh mesh(shared_.rest, pair.upper, pair.node);
      complete = complete && show({pair, mesh, group}, {}, watcher);
      for (const auto& clip : shared_.clips) {
        if (!poses || !mesh.is_moved_by(*clip)) continue;
        for (std::size_t i = 0; complete && i < clip->times().size(); ++i) {
          complete = show({pair, mesh, group}, {clip.get(), i}, watcher);
        }
      }
    });
    return complete;
  }
  bool moves() {
    bool moves = false;
    for (const Pair& pair : pairs_) {
      const PosedMesh mesh(shared_.rest, pair.upper, pair.node);
      moves = moves || std::any_of(shared_.clips.begin(), shared_.clips.end(),
                                   [&](const auto& clip) { return mesh.is_moved_by(*clip); });
    }
    return moves;
  }

 private:
  /// A node below a volume, or its own.
  struct Pair {
    std::size_t slot = 0;  ///< of the verdict
    NodeIndex upper = 0, node = 0;
    bool has_mesh = false;  ///< else points of another asset
  };
  /// Nodes that draw one mesh with one skin.
  struct Group {
    std::optional<PointBlocks> read;
    const PointBlocks* blocks = nullptr;
    bool tried = false;
    bool morphs = false;
    Box bounds;  ///< as accessors state them; empty: unknown
  };
  struct Shown {
    const Pair& pair;
    PosedMesh& mesh;
    Group& group;
  };

  bool collect(NodeIndex upper, std::size_t slot) {
    bool complete = true;
    std::vector<NodeIndex> open{upper};
    while (!open.empty()) {
      const NodeIndex node = open.back();
      open.pop_back();
      if (shared_.pairs == 0) return false;
      --shared_.pairs;
      if (source_.views.nodes[node].mesh) pairs_.push_back({slot, upper, node, true});
      if (of_.more_ != nullptr && of_.more_->of(node, complete) != nullptr) {
        pairs_.push_back({slot, upper, node, false});
      }
      open.insert(open.end(), shared_.children[node].begin(), shared_.children[node].end());
    }
    return complete;
  }

  auto key_of(const Pair& pair) const {
    const Node& node = source_.views.nodes[pair.node];
    return std::tuple(!pair.has_mesh, pair.has_mesh ? *node.mesh : pair.node,
                      pair.has_mesh && node.skin ? *node.skin + std::uint64_t{1} : 0);
  }

  // A mesh is read once for all nodes that draw it, and forgotten.
  void for_each_group(const std::function<void(const Pair&, Group&)>& use) {
    std::stable_sort(pairs_.begin(), pairs_.end(),
                     [&](const Pair& a, const Pair& b) { return key_of(a) < key_of(b); });
    for (std::size_t first = 0; first < pairs_.size();) {
      std::size_t last = first;
      while (last < pairs_.size() && key_of(pairs_[last]) == key_of(pairs_[first])) ++last;
      Group group;
      prepare(first, last, group);
      for (; first < last; ++first) use(pairs_[first], group);
    }
  }

  void prepare(std::size_t first, std::size_t last, Group& group) {
    bool complete = true;
    if (!pairs_[first].has_mesh) {
      group.blocks = of_.more_->of(pairs_[first].node, complete);
      return;
    }
    const std::uint32_t index = *source_.views.nodes[pairs_[first].node].mesh;
    const Mesh& mesh = source_.views.meshes[index];
    const bool has_targets = std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                                         [](const auto& each) { return !each.targets.empty(); });
    for (std::size_t i = first; has_targets && !group.morphs && i < last; ++i) {
      const NodeIndex node = pairs_[i].node;
      const auto weights = morph_weights(source_.asset, source_.views, node);
      group.morphs = std::any_of(weights.begin(), weights.end(), [](float w) { return w != 0; }) ||
                     std::any_of(shared_.clips.begin(), shared_.clips.end(),
                                 [&](const auto& clip) { return clip->morphs(node, index); });
    }
    if (!group.morphs) group.bounds = stated_bounds(source_, mesh);
  }

  bool read(const Shown& shown) {
    Group& group = shown.group;
    if (group.tried || group.blocks != nullptr) return group.blocks != nullptr;
    group.tried = true;
    MemoryBudget budget(saturating_add(
        std::uint64_t{1} << 28U,
        checked_mul(source_.resources.buffer_bytes(), kWorkOfByte).value_or(UINT64_MAX)));
    const Mesh& mesh = source_.views.meshes[*source_.views.nodes[shown.pair.node].mesh];
    auto blocks = PointBlocks::read(source_, mesh, shown.mesh.joints(), group.morphs, budget);
    if (!blocks) return false;
    shared_.work -= std::min<std::uint64_t>(shared_.work, blocks->size());
    group.blocks = &group.read.emplace(*std::move(blocks));
    return true;
  }

  // Nothing: the copies of the node cannot be read.
  std::optional<std::vector<Affine>> copies_of(const Shown& shown) const {
    if (!shown.pair.has_mesh || shown.mesh.joints() > 0) return std::vector{Affine()};
    MemoryBudget budget(kCopyBytes);
    auto copies = read_instancing(source_.asset, source_.views, source_.resources,
                                  source_.views.nodes[shown.pair.node], budget);
    if (!copies) return std::vector{Affine()};
    return copies->readable ? std::optional(std::move(copies->transforms)) : std::nullopt;
  }

  // Shows a mesh at one moment. False: it cannot be read, or there is too much work.
  bool show(const Shown& shown, const PosedMoment& at, PointWatcher& watcher) {
    if (!shown.mesh.is_sound() || shared_.work <= shown.mesh.steps()) return false;
    shared_.work -= shown.mesh.steps();
    if (!shown.mesh.place(at, matrices_)) return true;
    const Affine frame = volumes_[shown.pair.slot]->to_frame();
    for (Affine& each : matrices_) each = frame * each;
    const std::vector<float> weights =
        shown.pair.has_mesh && shown.group.morphs ? shown.mesh.weights(at) : std::vector<float>();
    const auto copies = copies_of(shown);
    if (!copies) return false;
    for (const Affine& copy : *copies) {
      if (shared_.work == 0) return false;
      --shared_.work;
      std::vector<Affine> placed = matrices_;
      for (Affine& each : placed) each = each * copy;
      const Box& bounds = shown.group.bounds;
      if (!bounds.empty() && shown.mesh.joints() == 0 &&
          !watcher.wants(moved_box(placed.front(), bounds))) {
        continue;
      }
      if (!read(shown) || !shown.group.blocks->visit({placed, weights}, shared_.work, watcher)) {
        return false;
      }
    }
    return true;
  }

  void judge(const Pair& pair, Group& group) {
    VolumeVerdict& verdict = verdicts_[pair.slot];
    PosedMesh mesh(shared_.rest, pair.upper, pair.node);
    const Shown shown{pair, mesh, group};
    std::vector<ClipMoments*> clips;
    for (const auto& clip : shared_.clips) {
      if (mesh.is_moved_by(*clip)) clips.push_back(clip.get());
    }
    // What does not move is only of interest outside.
    const double floor = clips.empty() ? 0.0 : verdict.at_rest.distance;
    if (const auto miss = look(shown, {}, std::max(verdict.at_rest.distance, floor))) {
      verdict.at_rest = *miss;
      keep(verdict, *miss);
    }
    for (ClipMoments* const clip : clips) {
      verdict.moves = true;
      play(shown, *clip);
    }
  }

  static void keep(VolumeVerdict& verdict, const VolumeMiss& miss) {
    if (miss.distance > verdict.greatest.distance) verdict.greatest = miss;
  }

  // How far below the greatest distance others are followed: between moments they may be greater.
  double margin_of(const Shown& shown) const { return kNear * volumes_[shown.pair.slot]->size(); }

  void play(const Shown& shown, ClipMoments& clip) {
    constexpr std::size_t kMostPeaks = 8;
    VolumeVerdict& verdict = verdicts_[shown.pair.slot];
    std::vector<double> heights(clip.times().size(), -HUGE_VAL);
    for (std::size_t i = 0; i < heights.size() && verdict.complete; ++i) {
      const auto miss = look(shown, {&clip, i}, verdict.greatest.distance - margin_of(shown));
      if (!miss) continue;
      heights[i] = miss->distance;
      keep(verdict, *miss);
    }
    std::vector<std::pair<double, std::size_t>> peaks;
    const double least = verdict.greatest.distance - margin_of(shown);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const bool rises = i == 0 || heights[i] > heights[i - 1];
      const bool falls = i + 1 == heights.size() || heights[i] >= heights[i + 1];
      if (rises && falls && heights[i] >= least) peaks.emplace_back(-heights[i], i);
    }
    std::sort(peaks.begin(), peaks.end());
    peaks.resize(std::min(peaks.size(), kMostPeaks));
    for (const auto& [height, moment] : peaks) climb(shown, clip, moment, -height);
  }

  // The vertex that is farthest outside at one moment, if that is more than `beyond`.
  std::optional<VolumeMiss> look(const Shown& shown, const PosedMoment& at, double beyond) {
    MissWatcher watcher(*volumes_[shown.pair.slot], beyond);
    if (!show(shown, at, watcher)) verdicts_[shown.pair.slot].complete = false;
    if (!watcher.found()) return std::nullopt;
    VolumeMiss miss;
    miss.distance = watcher.most();
    miss.node = shown.pair.node;
    miss.vertex = shown.group.blocks->origin_of(*watcher.found());
    miss.reach = watcher.reach();
    if (at.clip != nullptr) {
      miss.animation = at.clip->animation();
      miss.time = at.time();
    }
    return miss;
  }

  // From a moment to the greatest distance near it.
  void climb(const Shown& shown, ClipMoments& clip, std::size_t moment, double height) {
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
      keep(verdict, *miss);
      return true;
    };
    for (int i = 0; i < kSteps && step > 0 && verdict.complete; ++i) {
      if (!rises_at(time + step) && !rises_at(time - step)) step /= 2;
    }
  }

  VolumeContents& of_;
  const GeometrySource& source_;
  Shared& shared_;
  std::vector<Pair> pairs_;
  std::vector<VolumeVerdict> verdicts_;
  std::vector<const BoundingVolume*> volumes_;  ///< by verdict
  std::vector<Affine> matrices_;
};

VolumeContents::VolumeContents(const GeometrySource& source, const schema::Set& schemas,
                               MorePoints* more)
    : source_(source),
      schemas_(schemas),
      more_(more),
      volumes_(read_bounding_volumes(source.asset, source.views.nodes)) {}

VolumeContents::~VolumeContents() = default;

VolumeContents::Shared& VolumeContents::shared() {
  if (!shared_) shared_ = std::make_unique<Shared>(source_, schemas_);
  return *shared_;
}

std::vector<VolumeVerdict> VolumeContents::judge() {
  const bool any = std::any_of(volumes_.begin(), volumes_.end(),
                               [](const auto& each) { return each.has_value(); });
  if (!any) return {};
  Search search(*this);
  for (NodeIndex i = 0; i < volumes_.size(); ++i) {
    if (volumes_[i]) search.add(i, *volumes_[i]);
  }
  search.judge();
  return std::move(search.verdicts());
}

std::optional<FittedVolume> VolumeContents::fit(NodeIndex node, bool poses) {
  constexpr int kTries = 8;
  constexpr double kMore = 1.5;
  BoundingVolume volume = *volumes_[node];
  volume.center = {};
  volume.half = {};
  Search extents(*this);
  extents.add(node, volume);
  if (!poses && extents.moves()) return std::nullopt;
  ExtentWatcher box;
  if (!extents.show(box, poses) || box.all().empty()) return std::nullopt;
  const Affine from_frame = Affine::from_parts({}, volume.rotation, {1, 1, 1});
  const Vector3 middle = box.all().center();
  volume.center = from_frame.vector(middle);
  for (std::size_t k = 0; k < 3; ++k) volume.half[k] = box.all().greatest[k] - middle[k];
  // A box is done; a sphere has a radius from its center, and moments between others may be worse.
  for (int i = 0; i < kTries; ++i) {
    if (!volume.is_box && i == 0) volume.half = {};
    Search search(*this);
    search.add(node, volume);
    search.judge();
    const VolumeVerdict& verdict = search.verdicts().front();
    if (!verdict.complete) return std::nullopt;
    const VolumeMiss& miss = poses ? verdict.greatest : verdict.at_rest;
    const bool first_radius = !volume.is_box && i == 0;
    if (!first_radius && miss.distance <= tolerance_of(volume, miss)) {
      return FittedVolume{volume.half, volume.center};
    }
    // Where one moment between those that were sampled is worse, others may be, too.
    const double by = first_radius ? 1 : kMore;
    for (double& each : volume.half) each += by * std::max(miss.distance, 0.0);
  }
  return std::nullopt;
}

}  // namespace gltfx::model

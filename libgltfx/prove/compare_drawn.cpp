// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_drawn.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "model/keyframes.hpp"
#include "prove/column.hpp"
#include "prove/rigid_surfaces.hpp"

namespace gltfx::prove {
namespace {

constexpr std::size_t kMostScenes = 16;
constexpr std::size_t kMostMoments = 64;  // of an animation

/// A scene of each asset; nothing: the asset has none.
using ScenePair = std::pair<std::optional<std::uint32_t>, std::optional<std::uint32_t>>;

/// Values of both assets at one time of an animation.
struct Moment {
  model::AnimatedValues ours, theirs;
};

// Scenes that are partners; those that are shown first also if they are none.
std::vector<ScenePair> pair_scenes(const Comparison& all) {
  const auto shown = [](const Content& content) {
    return model::choose_scene(content.side().asset(), content.side().views()).scene;
  };
  std::vector<ScenePair> pairs;
  all.for_each_pair(
      "/scenes", [&](ItemId ours, ItemId theirs) { pairs.emplace_back(ours.index, theirs.index); });
  const ScenePair first(shown(all.ours), shown(all.theirs));
  if (std::find(pairs.begin(), pairs.end(), first) == pairs.end()) pairs.push_back(first);
  return pairs;
}

// Times of keyframes, and times between them.
std::vector<double> times_of(const Comparison& all, ItemId ours, ItemId theirs) {
  std::vector<double> keys;
  const auto add = [&](const Side& side, std::uint32_t animation) {
    for (const model::AnimationSampler& sampler : side.views().animations[animation].samplers) {
      const auto column = sampler.input ? Column::open(side, *sampler.input) : std::nullopt;
      if (!column) continue;
      const std::uint64_t step = 1 + column->count() / (4 * kMostMoments);
      for (std::uint64_t i = 0; i < column->count(); i += step) keys.push_back(column->at(i)[0]);
    }
  };
  add(all.ours.side(), ours.index);
  add(all.theirs.side(), theirs.index);
  std::erase_if(keys, [](double time) { return !std::isfinite(time); });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::vector<double> times;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0) times.push_back((keys[i - 1] + keys[i]) / 2);
    times.push_back(keys[i]);
  }
  // An odd step takes keyframes and what is between them in turn.
  const std::size_t step = times.size() / kMostMoments | 1U;
  std::vector<double> chosen;
  for (std::size_t i = 0; i < times.size(); i += step) chosen.push_back(times[i]);
  return chosen;
}

class DrawnComparison {
 public:
  explicit DrawnComparison(const Comparison& all) : all_(all), scenes_(pair_scenes(all)) {
    find_kept();
  }

  void run() {
    if (scenes_.size() > kMostScenes) return;
    const bool animated = all_.ours.side().asset().count(model::RootArray::animations) +
                              all_.theirs.side().asset().count(model::RootArray::animations) >
                          0;
    if (animated && compare(Motions::all)) return;
    compare(Motions::none);
  }

 private:
  static RigidSurfaces surfaces(const Content& content, const NodeTree& nodes,
                                std::optional<std::uint32_t> scene, Motions motions,
                                const std::vector<bool>& kept) {
    const Side& side = content.side();
    const model::SceneRoots roots = model::choose_scene(side.asset(), side.views(), scene);
    return {content, nodes, roots, motions, kept};
  }

  // Nodes whose place in the scene is the same, wherever they hang.
  void find_kept() {
    kept_.ours.assign(all_.our_nodes.size(), false);
    kept_.theirs.assign(all_.their_nodes.size(), false);
    all_.for_each_pair("/nodes", [&](ItemId ours, ItemId theirs) {
      const model::Affine& one = all_.our_nodes.world(ours.index);
      const model::Affine& other = all_.their_nodes.world(theirs.index);
      if (!is_same_place(one, other)) return;
      kept_.ours[ours.index] = kept_.theirs[theirs.index] = true;
    });
  }

  bool is_same_place(const model::Affine& one, const model::Affine& other) const {
    constexpr double kRounding = 1e-5;
    for (std::size_t i = 0; i < 4; ++i) {
      const double size = std::sqrt(model::dot(one.columns[i], one.columns[i]));
      const double most = i < 3 ? kRounding * size : all_.options.bounds.position * all_.diagonal;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::fabs(one.columns[i][k] - other.columns[i][k]) <= most)) return false;
      }
    }
    return true;
  }

  // Whether all are the same, or within bounds.
  bool compare(Motions motions) {
    changes_.clear();
    keeps_others_ = true;
    for (const auto& [one, other] : scenes_) {
      ours_.emplace(surfaces(all_.ours, all_.our_nodes, one, motions, kept_.ours));
      theirs_.emplace(surfaces(all_.theirs, all_.their_nodes, other, motions, kept_.theirs));
      if (!ours_->fits() || !theirs_->fits()) return false;
      keeps_others_ = keeps_others_ && keeps_others();
      if (!compare_at({})) return false;
      if (motions == Motions::all && !compare_moments()) return false;
    }
    const bool differ = std::any_of(changes_.begin(), changes_.end(), [](const Change& change) {
      return change.level == CompareLevel::differs;
    });
    if (differ && (motions == Motions::all || !explains())) return false;
    all_.log.forget([&](const Change& change) { return covers(change); });
    std::stable_sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) {
      return share_of_bound(a) > share_of_bound(b);
    });
    for (Change& change : changes_) all_.log.add(std::move(change));
    return true;
  }

  bool compare_moments() {
    bool fits = true;
    all_.for_each_pair("/animations", [&](ItemId ours, ItemId theirs) {
      const std::vector<double> times = times_of(all_, ours, theirs);
      const std::uint64_t work = (ours_->elements() + theirs_->elements()) * times.size();
      fits = fits && work <= 2 * RigidSurfaces::kMostElements;
      for (std::size_t i = 0; fits && i < times.size(); ++i) {
        const auto sample = [&](const Side& side, ItemId animation) {
          return model::sample_animation(side.asset(), side.views(), side.resources(),
                                         side.graph().set(), animation.index, times[i])
              .values;
        };
        const Moment moment{sample(all_.ours.side(), ours), sample(all_.theirs.side(), theirs)};
        const std::size_t told = changes_.size();
        fits = compare_at(moment);
        for (std::size_t k = told; k < changes_.size(); ++k) {
          fits = fits && changes_[k].level != CompareLevel::differs;
          changes_[k].time = times[i];
        }
      }
    });
    return fits;
  }

  // Whether all could be compared.
  bool compare_at(const Moment& moment) {
    SurfacePair pair;
    pair.ours = ours_->pieces(moment.ours);
    pair.theirs = theirs_->pieces(moment.theirs);
    pair.our_place = pair.their_place = "/meshes";
    SurfaceChanges found = compare_surfaces(all_, pair);
    std::move(found.changes.begin(), found.changes.end(), std::back_inserter(changes_));
    return !found.unread;
  }

  // Whether what else is drawn is in the scenes of both.
  bool keeps_others() const {
    bool keeps = true;
    const auto check = [&](const RigidSurfaces& here, const RigidSurfaces& there, std::uint32_t one,
                           ItemId other) {
      if (here.draws_more(one)) keeps = keeps && other && there.draws_more(other.index);
    };
    const std::uint32_t our_list = all_.ours.list("/nodes");
    for (std::uint32_t i = 0; i < all_.our_nodes.size(); ++i) {
      check(*ours_, *theirs_, i, all_.match.theirs({our_list, i}));
    }
    const std::uint32_t their_list = all_.theirs.list("/nodes");
    for (std::uint32_t i = 0; i < all_.their_nodes.size(); ++i) {
      check(*theirs_, *ours_, i, all_.match.ours({their_list, i}));
    }
    return keeps;
  }

  bool covers(const Change& change) const {
    if (change.kind == "scene.nodes" && !keeps_others_) return false;
    if (change.kind == "node.value") {
      return ours_->covers_value(change.old_pointer) && theirs_->covers_value(change.new_pointer);
    }
    const bool shape = change.kind.starts_with("geometry.") || change.kind.starts_with("node.") ||
                       change.kind == "mesh.value" || change.kind == "scene.nodes" ||
                       change.kind == "animation.channel" || change.kind == "animation.curve" ||
                       change.kind == "animation.interpolation";
    if (!shape || !ours_->covers(change.old_pointer) || !theirs_->covers(change.new_pointer)) {
      return false;
    }
    return change.kind != "scene.nodes" ||
           std::all_of(change.also.begin(), change.also.end(),
                       [&](const std::string& root) { return ours_->covers(root); });
  }

  // Whether what differs in the scene says more than changes of nodes and meshes that make up for
  // each other: nodes were replaced by others, or moved while their meshes moved back.
  bool explains() const {
    bool lost = false, found = false;
    std::size_t count = 0;
    double told = 0, drawn = 0;
    const auto is_place = [](const Change& change) {
      return change.measure && change.measure->quantity == "position";
    };
    for (const Change& change : all_.log.changes()) {
      if (change.level != CompareLevel::differs || !covers(change)) continue;
      ++count;
      lost |= !change.new_pointer;
      found |= !change.old_pointer;
      if (is_place(change)) told = std::max(told, share_of_bound(change));
    }
    for (const Change& change : changes_) {
      if (is_place(change)) drawn = std::max(drawn, share_of_bound(change));
    }
    if (lost && found && count > changes_.size()) return true;
    return told > 0 && 2 * drawn < told;
  }

  const Comparison& all_;
  const std::vector<ScenePair> scenes_;
  std::optional<RigidSurfaces> ours_, theirs_;
  struct {
    std::vector<bool> ours, theirs;
  } kept_;  ///< by node
  bool keeps_others_ = true;
  std::vector<Change> changes_;
};

}  // namespace

void compare_drawn(const Comparison& comparison) { DrawnComparison(comparison).run(); }

}  // namespace gltfx::prove

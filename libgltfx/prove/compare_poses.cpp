// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_poses.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/keyframes.hpp"
#include "prove/column.hpp"
#include "prove/skinned_corners.hpp"

namespace gltfx::prove {
namespace {

constexpr std::size_t kMostTimes = 64;
constexpr std::uint64_t kMostWork = std::uint64_t{1} << 24U;  // corners in poses

/// A pair of meshes at matched nodes with skins.
struct SkinnedUse {
  std::pair<std::uint32_t, std::uint32_t> skins;
  std::string name, our_place, their_place;
  std::vector<ComparedCorners> primitives;
  double farthest = 0;
  std::string pose;  ///< of the greatest distance

  std::size_t corners() const {
    std::size_t all = 0;
    for (const ComparedCorners& each : primitives) {
      all += each.rest.here.size() + each.moved.here.size();
    }
    return all;
  }
};

/// An animation of each asset that are partners.
struct AnimationPair {
  std::uint32_t ours = 0, theirs = 0;
  std::string name;
  std::vector<double> times;
};

class PoseComparison {
 public:
  explicit PoseComparison(const Comparison& all)
      : all_(all),
        before_(all.ours.side()),
        after_(all.theirs.side()),
        roots_{model::choose_scene(before_.asset(), before_.views()),
               model::choose_scene(after_.asset(), after_.views())} {}

  void run() {
    collect();
    leave_out_permuted();
    if (uses_.empty()) return;
    find_animations();
    pose({}, {}, "at rest");
    for (const AnimationPair& pair : animations_) {
      for (const double time : pair.times) {
        const auto sample = [&](const Side& side, std::uint32_t index) {
          return model::sample_animation(side.asset(), side.views(), side.resources(),
                                         side.graph().set(), index, time)
              .values;
        };
        pose(sample(before_, pair.ours), sample(after_, pair.theirs),
             fmt::format("{} at {:.4g} s", pair.name, time));
      }
    }
    for (const SkinnedUse& use : uses_) tell(use);
  }

 private:
  void collect() {
    std::set<std::pair<json::NodeId, std::pair<std::uint32_t, std::uint32_t>>> seen;
    all_.for_each_pair("/nodes", [&](ItemId ours, ItemId theirs) {
      const model::Node& here = before_.views().nodes[ours.index];
      const model::Node& there = after_.views().nodes[theirs.index];
      if (!here.mesh || !there.mesh || !here.skin || !there.skin) return;
      const model::Mesh& mesh = before_.views().meshes[*here.mesh];
      const model::Mesh& other = after_.views().meshes[*there.mesh];
      const std::pair skins(*here.skin, *there.skin);
      if (!seen.insert({mesh.node, skins}).second) return;
      if (mesh.primitives.size() != other.primitives.size()) return;
      SkinnedUse use;
      use.skins = skins;
      use.name = all_.our_name({all_.ours.list("/meshes"), *here.mesh});
      use.our_place = before_.pointer(mesh.node);
      use.their_place = after_.pointer(other.node);
      for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        const json::NodeId one = mesh.primitives[i].node;
        const json::NodeId two = other.primitives[i].node;
        if (one == json::kNoNode || two == json::kNoNode) continue;
        auto corners = read_corners(before_, after_, one, two);
        if (corners && corners->sets > 0) use.primitives.push_back(*std::move(corners));
      }
      if (!use.primitives.empty()) uses_.push_back(std::move(use));
    });
  }

  // Surfaces are within bounds here, so that vertices far from each other at rest do not belong
  // together: equal lists of indices lead to vertices in another order.
  void leave_out_permuted() {
    constexpr double kFar = 8;  // bounds: of distances that add up
    constexpr double kRounded = 1e-6;
    const double most = kFar * std::max(all_.options.bounds.position, kRounded) * all_.diagonal;
    const PosePair rest{model::compute_pose(before_.asset(), before_.views(), roots_.here),
                        model::compute_pose(after_.asset(), after_.views(), roots_.there)};
    for (SkinnedUse& use : uses_) {
      const JointPair joints = read_joints(before_, after_, use.skins, rest);
      std::erase_if(use.primitives, [&](const ComparedCorners& corners) {
        return joints.here.size() == joints.there.size() &&
               farthest_skinned(corners, joints) > most;
      });
    }
    std::erase_if(uses_, [](const SkinnedUse& use) { return use.primitives.empty(); });
  }

  // Times of keyframes of both assets, evenly chosen.
  void find_animations() {
    std::uint64_t corners = 1;
    for (const SkinnedUse& use : uses_) corners += use.corners();
    std::size_t poses = 0;
    all_.for_each_pair("/animations", [&](ItemId ours, ItemId theirs) {
      AnimationPair pair;
      pair.ours = ours.index;
      pair.theirs = theirs.index;
      pair.name = Comparison::called(all_.ours, ours);
      std::vector<double> times;
      add_times(before_, before_.views().animations[ours.index], times);
      add_times(after_, after_.views().animations[theirs.index], times);
      std::sort(times.begin(), times.end());
      times.erase(std::unique(times.begin(), times.end()), times.end());
      const std::size_t count = std::min(times.size(), kMostTimes);
      for (std::size_t i = 0; i < count; ++i) {
        if (++poses * corners > kMostWork) break;
        pair.times.push_back(count < 2 ? times[i] : times[i * (times.size() - 1) / (count - 1)]);
      }
      animations_.push_back(std::move(pair));
    });
  }

  static void add_times(const Side& side, const model::Animation& animation,
                        std::vector<double>& times) {
    for (const model::AnimationSampler& sampler : animation.samplers) {
      const auto column = sampler.input ? Column::open(side, *sampler.input) : std::nullopt;
      if (!column) continue;
      // A few of each.
      const std::uint64_t step = 1 + column->count() / (4 * kMostTimes);
      for (std::uint64_t i = 0; i < column->count(); i += step) {
        const double time = column->at(i)[0];
        if (std::isfinite(time)) times.push_back(time);
      }
    }
  }

  void pose(const model::AnimatedValues& here, const model::AnimatedValues& there,
            const std::string& name) {
    const PosePair poses{model::compute_pose(before_.asset(), before_.views(), roots_.here, here),
                         model::compute_pose(after_.asset(), after_.views(), roots_.there, there)};
    for (SkinnedUse& use : uses_) {
      const JointPair joints = read_joints(before_, after_, use.skins, poses);
      if (joints.here.size() != joints.there.size()) continue;
      for (const ComparedCorners& corners : use.primitives) {
        const double distance = farthest_skinned(corners, joints);
        if (!(distance > use.farthest)) continue;
        use.farthest = distance;
        use.pose = name;
      }
    }
  }

  void tell(const SkinnedUse& use) {
    if (!(all_.diagonal > 0)) return;
    constexpr double kRounding = 1e-9;
    const double part = use.farthest / all_.diagonal;
    const double bound = all_.options.bounds.position;
    // Within bounds, the changes that move it are told.
    if (!(part > std::max(kRounding, bound))) return;
    Change change;
    change.kind = "geometry.position";
    change.old_pointer = use.our_place;
    change.new_pointer = use.their_place;
    change.name = use.name;
    change.what = fmt::format("a vertex with joints is up to {:.4g} away, {}", use.farthest,
                              printable(use.pose));
    change.measure = CompareMeasure{"position", 100 * part, "%", 100 * bound};
    all_.log.add(std::move(change));
  }

  const Comparison& all_;
  const Side& before_;
  const Side& after_;
  struct {
    model::SceneRoots here, there;
  } roots_;
  std::vector<SkinnedUse> uses_;
  std::vector<AnimationPair> animations_;
};

}  // namespace

void compare_poses(const Comparison& all) {
  bool any = false;
  for (const Change& change : all.log.changes()) {
    const bool moves = change.kind.starts_with("geometry.") || change.kind.starts_with("skin.") ||
                       change.kind.starts_with("animation.") || change.kind == "node.moved";
    if (moves && change.level == CompareLevel::differs) return;
    any |= moves;
  }
  if (any) PoseComparison(all).run();
}

}  // namespace gltfx::prove

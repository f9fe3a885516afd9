// SPDX-License-Identifier: Apache-2.0
#include "prove/regridded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "model/instancing.hpp"
#include "model/inverse.hpp"
#include "model/longest_axis.hpp"
#include "model/material.hpp"
#include "model/pose.hpp"
#include "model/scene_box.hpp"
#include "model/scene_diagonal.hpp"
#include "prove/primitive_pair.hpp"
#include "prove/skinned_corners.hpp"

namespace gltfx::prove {
namespace {

using model::Affine;
using model::Vector3;

// Places of a mesh whose corners are all compared, and the corners of an asset that are.
constexpr std::size_t kMostPlaces = 64;
constexpr std::uint64_t kMostCorners = std::uint64_t{1} << 28U;
constexpr const char* kTooMany = "has too many corners to compare";
constexpr std::uint64_t kInstanceBytes = std::uint64_t{1} << 28U;

double distance(const Vector3& a, const Vector3& b) {
  const double away = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  return std::isnan(away) ? std::numeric_limits<double>::infinity() : away;
}

/// The transforms of one mesh at one place, before and after.
struct Place {
  Affine here, there;
  json::NodeId node = json::kNoNode;  ///< in `before`
};

/// All places of a pair of meshes that have one unit of distance.
struct Shown {
  std::vector<Place> rigid;
  /// Skins before and after, with a node.
  std::map<std::pair<std::uint32_t, std::uint32_t>, json::NodeId> skins;
  bool in_scene = false;
};

class PlaceComparison {
 public:
  PlaceComparison(const Side& before, const Side& after, const NodePairs& nodes,
                  const MeaningRequest& request, Differences& found)
      : before_(before), after_(after), nodes_(nodes), request_(request), found_(found) {}

  void run() {
    poses_ = read_poses(before_, after_);
    const auto& rest = poses_.front();
    scene_ = model::scene_diagonal(before_.source(), rest.here);
    for (const Pair& pair : nodes_.all()) add(pair, rest);
    for (const auto& [meshes, shown] : shown_) compare(meshes.first, meshes.second, shown);
  }

 private:
  void add(const Pair& pair, const PosePair& rest) {
    const model::Node& ours = before_.views().nodes[before_.index(pair.ours)];
    if (!ours.mesh) return;
    model::NodeIndex there = after_.index(pair.theirs);
    if (!after_.views().nodes[there].mesh) {
      const auto child = find_mesh_child(after_, nodes_, pair.theirs);
      if (!child) return;  // told by the walk
      there = *child;
    }
    const model::Node& theirs = after_.views().nodes[there];
    if (!theirs.mesh || ours.skin.has_value() != theirs.skin.has_value()) return;
    const std::uint32_t here = before_.index(pair.ours);
    Shown& shown = shown_[{*ours.mesh, *theirs.mesh}];
    shown.in_scene |= rest.here.in_scene[here] != 0;
    if (ours.skin) {
      shown.skins.try_emplace({*ours.skin, *theirs.skin}, pair.ours);
      return;
    }
    const Place place{rest.here.world[here], rest.there.world[there], pair.ours};
    add_copies(place, ours, theirs, shown);
  }

  void add_copies(const Place& place, const model::Node& ours, const model::Node& theirs,
                  Shown& shown) {
    const auto copies = model::read_instancing(before_.asset(), before_.views(),
                                               before_.resources(), ours, instances_);
    const auto now = model::read_instancing(after_.asset(), after_.views(), after_.resources(),
                                            theirs, instances_);
    if (!copies && !now) return shown.rigid.push_back(place);
    if ((copies && copies->too_large) || (now && now->too_large))
      return found_.add(before_.pointer(place.node), kTooMany);
    if (copies && now && !copies->readable && !now->readable) return;
    if (!copies || !now || copies->transforms.size() != now->transforms.size()) {
      return found_.add(before_.pointer(place.node), "has other instances");
    }
    for (std::size_t i = 0; i < copies->transforms.size(); ++i) {
      shown.rigid.push_back(
          {place.here * copies->transforms[i], place.there * now->transforms[i], place.node});
    }
  }

  void compare(std::uint32_t here, std::uint32_t there, const Shown& shown) {
    const auto& ours = before_.views().meshes[here].primitives;
    const auto& theirs = after_.views().meshes[there].primitives;
    std::vector<ComparedCorners> all;
    model::Box box;
    Compared compared;
    for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
      if (ours[i].node == json::kNoNode || theirs[i].node == json::kNoNode) continue;
      if (!shown.rigid.empty()) compare_thickness(ours[i], theirs[i], shown.rigid.front());
      if (!compared.add(storage_key(before_, ours[i].node))) continue;
      auto corners = read_corners(before_, after_, ours[i].node, theirs[i].node);
      if (!corners) continue;
      const std::size_t size = corners->rest.here.size() + corners->moved.here.size();
      if (size > read_left_) return found_.add(before_.pointer(ours[i].node), kTooMany);
      read_left_ -= size;
      for (const Vector3& at : corners->rest.here) box.add(at);
      all.push_back(*std::move(corners));
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      compare_rigid(all[i], shown, box.diagonal());
      for (const auto& [skins, node] : shown.skins)
        compare_skinned(all[i], skins, node, unit(shown, box.diagonal(), 1));
    }
  }

  // A length in the space of the mesh.
  void compare_thickness(const model::Primitive& ours, const model::Primitive& theirs,
                         const Place& place) {
    if (!ours.material || !theirs.material) return;
    const auto of = [](const Side& side, std::uint32_t material, const Affine& world) {
      const model::Material read = model::read_material(side.asset(), material);
      const float thickness = read.of(MaterialParameter::thickness)[0];
      return static_cast<double>(thickness) * model::longest_axis(world);
    };
    constexpr double kRounding = 1e-5;
    const double here = of(before_, *ours.material, place.here);
    const double there = of(after_, *theirs.material, place.there);
    if (std::abs(there - here) <= kRounding * here) return;
    found_.add(before_.pointer(ours.node),
               fmt::format("is {:.6g} thick in place of {:.6g}", there, here));
  }

  // At rest always, in other poses as long as there is time.
  void compare_skinned(const ComparedCorners& corners,
                       const std::pair<std::uint32_t, std::uint32_t>& skins, json::NodeId node,
                       double unit_length) {
    const std::size_t size = corners.rest.here.size() + corners.moved.here.size();
    std::vector<JointPair>& joints = joints_[skins];
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const bool is_rest = i == 0;
      if (i == joints.size()) joints.push_back(read_joints(before_, after_, skins, poses_[i]));
      if (size > (is_rest ? read_left_ : corners_left_)) {
        if (is_rest) found_.add(before_.pointer(node), kTooMany);
        return;
      }
      (is_rest ? read_left_ : corners_left_) -= size;
      note(farthest_skinned(corners, joints[i]) / unit_length, node);
    }
  }

  double unit(const Shown& shown, double own, double scale) const {
    return shown.in_scene ? scene_ : own * scale;
  }

  void note(double part, json::NodeId node) {
    if (std::isnan(part)) part = 0;  // of a box without size
    const std::string place = before_.pointer(node);
    found_.measure("POSITION", part, place);
    if (part <= request_.tolerance.position) return;
    found_.add(place, fmt::format("shows a position {:.6g} of the diagonal away", part), part);
  }

  void compare_rigid(const ComparedCorners& corners, const Shown& shown, double own) {
    const std::size_t size = corners.rest.here.size();
    std::size_t exact = std::min(shown.rigid.size(), kMostPlaces);
    while (exact > 1 && exact * size > corners_left_) exact /= 2;
    corners_left_ -= std::min<std::uint64_t>(corners_left_, exact * size);
    for (std::size_t i = 0; i < exact; ++i) {
      const Place& place = shown.rigid[i];
      double farthest = 0;
      for (const CornerList* list : {&corners.rest, &corners.moved}) {
        for (std::size_t k = 0; k < list->here.size(); ++k) {
          farthest = std::max(farthest, distance(place.here.point(list->here[k]),
                                                 place.there.point(list->there[k])));
        }
      }
      note(farthest / unit(shown, own, model::longest_axis(place.here)), place.node);
    }
    if (exact < shown.rigid.size()) limit(corners, shown, exact, own);
  }

  // Limits the distance at the other places. The first one gives the change of coordinates.
  void limit(const ComparedCorners& corners, const Shown& shown, std::size_t first, double own) {
    const auto back = model::inverse(shown.rigid.front().here);
    if (!back) return;
    const Affine change = *back * shown.rigid.front().there;
    double error = 0;
    model::Box box;
    for (const CornerList* list : {&corners.rest, &corners.moved}) {
      for (std::size_t k = 0; k < list->here.size(); ++k) {
        box.add(list->there[k]);
        error = std::max(error, distance(list->here[k], change.point(list->there[k])));
      }
    }
    for (std::size_t i = first; i < shown.rigid.size(); ++i) {
      const Place& place = shown.rigid[i];
      const double scale = model::longest_axis(place.here);
      const Affine here = place.here * change;
      double rounding = 0;
      for (unsigned corner = 0; corner < 8; ++corner) {
        Vector3 at = box.least;
        for (std::size_t k = 0; k < 3; ++k) {
          if ((corner >> k & 1U) != 0) at[k] = box.greatest[k];
        }
        rounding = std::max(rounding, distance(here.point(at), place.there.point(at)));
      }
      note((scale * error + rounding) / unit(shown, own, scale), place.node);
    }
  }

  const Side& before_;
  const Side& after_;
  const NodePairs& nodes_;
  const MeaningRequest& request_;
  Differences& found_;
  std::vector<PosePair> poses_;  ///< the first is that at rest
  /// By skins and poses.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<JointPair>> joints_;
  double scene_ = 0;                                                ///< diagonal
  std::map<std::pair<std::uint32_t, std::uint32_t>, Shown> shown_;  ///< by meshes
  std::uint64_t corners_left_ = kMostCorners;  ///< for exact comparison, and for poses
  std::uint64_t read_left_ = kMostCorners;
  model::MemoryBudget instances_{kInstanceBytes};
};

}  // namespace

std::optional<model::NodeIndex> find_mesh_child(const Side& after, const NodePairs& nodes,
                                                json::NodeId theirs) {
  const model::Node& node = after.views().nodes[after.index(theirs)];
  std::optional<std::uint32_t> last;
  model::for_each_index(after.asset(), node.children, model::RootArray::nodes,
                        [&](std::uint64_t, const auto& index, Span) { last = index; });
  if (!last) return std::nullopt;
  const model::Node& child = after.views().nodes[*last];
  if (!child.mesh || child.skin || child.camera || child.children != json::kNoNode ||
      child.extensions != json::kNoNode || child.extras != json::kNoNode ||
      after.document().holds(child.object, "name") || nodes.has_theirs(child.object)) {
    return std::nullopt;
  }
  return last;
}

void compare_places(const Side& before, const Side& after, const NodePairs& nodes,
                    const MeaningRequest& request, Differences& found) {
  PlaceComparison(before, after, nodes, request, found).run();
}

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
#include "prove/compare_copies.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "model/instancing.hpp"
#include "model/inverse.hpp"

namespace gltfx::prove {
namespace {

using Transforms = std::vector<model::Affine>;

std::optional<Transforms> transforms_of(const Side& side, const model::Node& node) {
  model::MemoryBudget budget(kCopyBytes);
  return read_copies(side, node, budget);
}

// The transform by which all copies differ: that of the first one with an inverse, if it brings
// the mesh to where the copies have it.
std::optional<model::Affine> common_place(const Transforms& ours, const Transforms& theirs,
                                          const Content::Box& box) {
  constexpr double kOfSize = 1e-5;   // rounding of scale and rotation
  constexpr double kOfPlace = 5e-7;  // rounding of the translation
  std::optional<model::Affine> place;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    if (!place) {
      const auto undone = model::inverse(ours[i]);
      if (!undone) continue;
      place = *undone * theirs[i];
    }
    const model::Vector3 one = theirs[i].point(box.corner(0));
    const model::Vector3 other = theirs[i].point(box.corner(7));
    double rounding = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      rounding += kOfSize * std::fabs(other[k] - one[k]) + kOfPlace * std::fabs(one[k]);
    }
    if (!(farthest_corner_of(box, ours[i] * *place, theirs[i]) <= rounding)) return std::nullopt;
  }
  return place;
}

/// The pointers to the transforms of the copies of two nodes.
struct CopyPlaces {
  std::string ours, theirs;

  CopyPlaces(const Comparison& all, std::uint32_t our_node, std::uint32_t their_node)
      : ours(place_of(all.ours.side(), our_node)),
        theirs(place_of(all.theirs.side(), their_node)) {}

  bool have(const Change& change) const {
    const auto below = [](const std::optional<std::string>& pointer, const std::string& place) {
      return pointer && pointer->starts_with(place) && is_transform(*pointer);
    };
    return below(change.old_pointer, ours) || below(change.new_pointer, theirs);
  }

 private:
  static std::string place_of(const Side& side, std::uint32_t node) {
    return side.pointer(model::instance_attributes(side.asset(), side.views().nodes[node])) + "/";
  }
  static bool is_transform(const std::string& pointer) {
    return pointer.ends_with("/TRANSLATION") || pointer.ends_with("/ROTATION") ||
           pointer.ends_with("/SCALE");
  }
};

}  // namespace

std::optional<CopiesPair> pair_copies(const Comparison& all, std::uint32_t our_node,
                                      std::uint32_t their_node) {
  const Side& here = all.ours.side();
  const Side& there = all.theirs.side();
  const model::Node& node = here.views().nodes[our_node];
  const model::Node& other = there.views().nodes[their_node];
  if (!node.mesh || !other.mesh) return std::nullopt;
  const auto ours = transforms_of(here, node);
  const auto theirs = ours ? transforms_of(there, other) : std::nullopt;
  if (!theirs || ours->size() != theirs->size()) return std::nullopt;
  CopiesPair pair;
  pair.count = ours->size();
  const Content::Box& box = all.ours.box(*node.mesh);
  for (std::size_t i = 0; i < ours->size(); ++i) {
    const double scale = greatest_scale_of((*ours)[i]);
    pair.scale = i == 0 ? scale : std::max(pair.scale, scale);
    if ((*ours)[i] == (*theirs)[i]) continue;
    ++pair.moved;
    const double distance = box.empty() ? 0 : farthest_corner_of(box, (*ours)[i], (*theirs)[i]);
    if (!(distance <= pair.movement)) pair.movement = distance;
  }
  const Content::Box& new_box = all.theirs.box(*other.mesh);
  if (pair.moved > 0 && !new_box.empty()) pair.place = common_place(*ours, *theirs, new_box);
  return pair;
}

void forget_copies(const Comparison& all, std::uint32_t our_node, std::uint32_t their_node) {
  const CopyPlaces places(all, our_node, their_node);
  all.log.forget([&](const Change& change) { return places.have(change); });
}

void tell_copies(const Comparison& all, std::uint32_t our_node, std::uint32_t their_node,
                 const CopiesPair& copies) {
  if (copies.moved == 0) return;
  const CopyPlaces places(all, our_node, their_node);
  std::vector<Change> told;
  all.log.forget([&](const Change& change) {
    if (!places.have(change)) return false;
    told.push_back(change);
    return true;
  });
  const double distance = copies.movement * all.our_nodes.greatest_scale(our_node);
  const double part = all.diagonal > 0 ? 100 * distance / all.diagonal : 0;
  const double bound = 100 * all.options.bounds.position;
  for (Change& change : told) {
    change.what = fmt::format("{} of {} copies moved by at most {:.4g}", copies.moved, copies.count,
                              distance);
    change.before.clear();
    change.after.clear();
    change.measure = CompareMeasure{"position", part, "%", bound};
    change.level = part <= bound && distance > 0 ? CompareLevel::bounds : CompareLevel::differs;
    all.log.add(std::move(change));
  }
}

}  // namespace gltfx::prove

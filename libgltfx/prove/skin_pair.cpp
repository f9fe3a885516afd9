// SPDX-License-Identifier: Apache-2.0
#include "prove/skin_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/inverse.hpp"
#include "prove/column.hpp"

namespace gltfx::prove {
namespace {

/// The joints of a skin with their matrices.
struct ReadSkin {
  model::Skin skin;
  std::vector<model::Affine> matrices;
};

ReadSkin read_skin_of(const Content& content, std::uint32_t index) {
  const Side& side = content.side();
  ReadSkin read;
  read.skin = model::read_skin(side.asset(), side.asset().elements(model::RootArray::skins)[index]);
  const auto column = read.skin.inverse_bind_matrices
                          ? Column::open(side, *read.skin.inverse_bind_matrices)
                          : std::nullopt;
  for (std::size_t i = 0; i < read.skin.joint_nodes.size(); ++i) {
    model::Affine matrix;
    if (column && column->components() == 16 && i < column->count()) {
      const Element element = column->at(i);
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t m = 0; m < 3; ++m) matrix.columns[k][m] = element[4 * k + m];
      }
    }
    read.matrices.push_back(matrix);
  }
  return read;
}

double farthest_of(const model::Affine& a, const model::Affine& b) {
  double farthest = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      farthest = std::max(farthest, apart(a.columns[i][k], b.columns[i][k]));
    }
  }
  return farthest;
}

// Of all meshes that each skin moves.
std::vector<Content::Box> skinned_boxes(const Content& content) {
  const Side& side = content.side();
  std::vector<Content::Box> boxes(side.asset().count(model::RootArray::skins),
                                  Content::Box::nothing());
  for (const model::Node& node : side.views().nodes) {
    if (node.skin && node.mesh) boxes[*node.skin].add(content.box(*node.mesh));
  }
  return boxes;
}

// Of an empty box, how far the entries of the matrices are apart.
double bind_movement(const Content::Box& box, const model::Affine& a, const model::Affine& b) {
  if (box.empty()) return farthest_of(a, b);
  return farthest_corner_of(box, a, b);
}

}  // namespace

const SkinPair& SkinPairs::get(std::uint32_t ours, std::uint32_t theirs) {
  const auto [at, is_new] = pairs_.try_emplace({ours, theirs});
  if (is_new) compare(ours, theirs);
  return at->second;
}

void SkinPairs::compare(std::uint32_t ours, std::uint32_t theirs) {
  SkinPair& pair = pairs_[{ours, theirs}];
  const ReadSkin here = read_skin_of(all_.ours, ours);
  const ReadSkin there = read_skin_of(all_.theirs, theirs);
  const std::uint32_t list = all_.theirs.list("/nodes");
  std::map<model::NodeIndex, std::size_t> positions;
  for (std::size_t i = 0; i < here.skin.joint_nodes.size(); ++i) {
    const model::NodeIndex node = here.skin.joint_nodes[i];
    positions.try_emplace(node, i);
    pair.our_joints.push_back(node);
    const double scale =
        greatest_scale_of(all_.our_nodes.world(node)) * greatest_scale_of(here.matrices[i]);
    pair.scale = i == 0 ? scale : std::max(pair.scale, scale);
  }
  constexpr double kUnmatched = 1e10;
  std::optional<model::Affine> place;
  bool one_place = true;
  bool differs = false;
  for (std::size_t i = 0; i < there.skin.joint_nodes.size(); ++i) {
    const ItemId partner = all_.match.ours({list, there.skin.joint_nodes[i]});
    pair.their_joints.push_back(partner ? partner.index : kUnmatched + there.skin.joint_nodes[i]);
    const auto found = partner ? positions.find(partner.index) : positions.end();
    if (found == positions.end()) continue;
    const model::Affine& before = here.matrices[found->second];
    const model::Affine& after = there.matrices[i];
    differs |= farthest_of(before, after) > 0;
    if (!place) {
      const auto undone = model::inverse(before);
      if (undone) place = *undone * after;
    }
    constexpr double kNear = 1e-5;
    one_place = one_place && place && farthest_of(before * *place, after) <= kNear;
  }
  pair.has_place = differs && one_place && place;
  if (pair.has_place) pair.place = *place;
}

// The first joint of their skin whose partner is none of ours; empty: none.
std::string SkinPairs::find_gained(const model::Skin& ours, const model::Skin& theirs) const {
  const std::uint32_t nodes = all_.theirs.list("/nodes");
  const std::set<model::NodeIndex> known(ours.joint_nodes.begin(), ours.joint_nodes.end());
  for (const model::NodeIndex node : theirs.joint_nodes) {
    const ItemId joint{nodes, node};
    const ItemId partner = all_.match.ours(joint);
    if (!partner || !known.contains(partner.index)) return Comparison::called(all_.theirs, joint);
  }
  return {};
}

void SkinPairs::tell_rest() {
  const std::uint32_t skins = all_.ours.list("/skins");
  const std::uint32_t nodes = all_.ours.list("/nodes");
  if (skins == kNoItem) return;
  const std::vector<Content::Box> our_boxes = skinned_boxes(all_.ours);
  const std::vector<Content::Box> their_boxes = skinned_boxes(all_.theirs);
  for (std::uint32_t i = 0; i < all_.ours.lists()[skins].items.size(); ++i) {
    const ItemId one{skins, i};
    const ItemId other = all_.match.theirs(one);
    if (!other || !all_.ours.side().document().is_object(all_.ours.item(one).node) ||
        !all_.theirs.side().document().is_object(all_.theirs.item(other).node)) {
      continue;
    }
    const ReadSkin here = read_skin_of(all_.ours, i);
    const ReadSkin there = read_skin_of(all_.theirs, other.index);
    std::map<model::NodeIndex, std::size_t> positions;
    for (std::size_t k = 0; k < there.skin.joint_nodes.size(); ++k) {
      positions.try_emplace(there.skin.joint_nodes[k], k);
    }
    const auto add = [&](std::string_view kind, std::string_view member,
                         std::string what) -> Change {
      Change change;
      change.kind = kind;
      change.name = all_.our_name(one);
      change.what = std::move(what);
      const auto at = [&](const Side& side, json::NodeId object) {
        const json::NodeId value = side.document().find(object, member);
        return side.pointer(value == json::kNoNode ? object : value);
      };
      change.old_pointer = at(all_.ours.side(), here.skin.object);
      change.new_pointer = at(all_.theirs.side(), there.skin.object);
      return change;
    };
    std::size_t shared = 0;
    std::string lost;
    double farthest = 0;
    double movement = 0;
    std::string worst;
    Content::Box box = our_boxes[i];
    box.add(their_boxes[other.index]);
    for (std::size_t k = 0; k < here.skin.joint_nodes.size(); ++k) {
      const ItemId joint{nodes, here.skin.joint_nodes[k]};
      const ItemId partner = all_.match.theirs(joint);
      const auto found = partner ? positions.find(partner.index) : positions.end();
      if (found == positions.end()) {
        if (lost.empty()) lost = Comparison::called(all_.ours, joint);
        continue;
      }
      ++shared;
      const model::Affine& matrix = there.matrices[found->second];
      const double distance = farthest_of(here.matrices[k], matrix);
      movement = std::max(movement, bind_movement(box, here.matrices[k], matrix) *
                                        all_.our_nodes.greatest_scale(joint.index));
      if (distance <= farthest) continue;
      farthest = distance;
      worst = Comparison::called(all_.ours, joint);
    }
    const std::string gained = find_gained(here.skin, there.skin);
    const bool other_joints = !gained.empty() || shared != here.skin.joint_nodes.size() ||
                              shared != there.skin.joint_nodes.size();
    if (other_joints) {
      const auto text = [&] {
        if (!lost.empty()) return fmt::format("{} is no joint any more", lost);
        if (!gained.empty()) return fmt::format("{} is a joint now", gained);
        return fmt::format("has {} joints in place of {}", there.skin.joint_nodes.size(),
                           here.skin.joint_nodes.size());
      };
      all_.log.add(add("skin.joints", "joints", text()));
    }
    if (farthest == 0 || explained_.contains({i, other.index})) continue;
    // The matrices are the same: other joints have them.
    if (other_joints && here.matrices == there.matrices) continue;
    Change change = add(
        "skin.bind", "inverseBindMatrices",
        fmt::format("the inverse bind matrix of {} differs by at most {:.4g}", worst, farthest));
    const double bound = 100 * all_.options.bounds.position;
    const double part = all_.diagonal > 0 ? 100 * movement / all_.diagonal
                                          : std::numeric_limits<double>::infinity();
    change.measure = CompareMeasure{"position", part, "%", bound};
    change.level = part <= bound ? CompareLevel::bounds : CompareLevel::differs;
    all_.log.add(std::move(change));
  }
}

}  // namespace gltfx::prove

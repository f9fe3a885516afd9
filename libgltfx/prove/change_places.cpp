// SPDX-License-Identifier: Apache-2.0
#include "prove/change_places.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <unordered_map>

#include "base/json_pointer.hpp"
#include "json/lines.hpp"
#include "model/keyframes.hpp"
#include "model/pose.hpp"

namespace gltfx::prove {
namespace {

constexpr std::size_t kMostBoxes = 1000;

std::optional<std::uint32_t> index_in(std::string_view step) {
  std::uint32_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (error != std::errc() || end != step.data() + step.size()) return std::nullopt;
  return index;
}

/// The nodes that show the objects of one asset.
class ShownBoxes {
 public:
  /// `worlds`: of the nodes in another pose than at rest, or empty.
  ShownBoxes(const Content& content, const NodeTree& tree, const std::vector<model::Affine>& worlds)
      : content_(content), tree_(tree), worlds_(worlds), nodes_(content.list("/nodes")) {
    find_subtrees();
    for (std::uint32_t list = 0; list < content.lists().size(); ++list) {
      const auto& items = content.lists()[list].items;
      for (std::uint32_t i = 0; i < items.size(); ++i) add_users({list, i});
    }
  }

  model::Box box(const std::string& pointer) {
    const auto steps = split_pointer(pointer);
    if (!steps || steps->size() < 2) return {};
    const auto index = index_in((*steps)[1]);
    if (!index) return {};
    const ItemId item{content_.list("/" + (*steps)[0]), *index};
    if (item.list == kNoItem || item.index >= content_.lists()[item.list].items.size()) return {};
    if (item.list == nodes_) return box_of(item.index, true);
    if ((*steps)[0] == "animations") return box_of_curve(item.index, *steps);
    return box_of_users(item);
  }

 private:
  static std::uint64_t key_of(ItemId item) {
    return (std::uint64_t{item.list} << 32U) | item.index;
  }

  void add_users(ItemId user) {
    if (content_.lists()[user.list].pointer == "/scenes") return;
    const Item& item = content_.item(user);
    for (std::uint32_t i = item.first; i < item.last; ++i) {
      const Leaf& leaf = content_.leaves()[i];
      const bool goes_up = leaf.kind != LeafKind::joint && leaf.kind != LeafKind::channel;
      if (leaf.target && leaf.target.list != nodes_ && goes_up) {
        users_[key_of(leaf.target)].push_back(user);
      }
    }
  }

  const model::Affine& world(std::uint32_t node) const {
    return worlds_.empty() ? tree_.world(node) : worlds_[node];
  }

  // The mesh of a node in the scene, or the node as a point.
  model::Box own_box(std::uint32_t node) const {
    model::Box box;
    const auto mesh = content_.side().views().nodes[node].mesh;
    const bool alone = tree_.children(node).empty();  // then it has the copies of the mesh, too
    Content::Box own = Content::Box::nothing();
    if (mesh) own = alone ? tree_.box(node) : content_.box(*mesh);
    if (own.empty()) own.add(model::Vector3{});
    for (unsigned i = 0; i < 8; ++i) box.add(world(node).point(own.corner(i)));
    return box;
  }

  void find_subtrees() {
    below_.resize(tree_.size());
    for (auto at = tree_.order().rbegin(); at != tree_.order().rend(); ++at) {
      const model::Box own = own_box(*at);
      below_[*at].add(own.least);
      below_[*at].add(own.greatest);
      const model::NodeIndex above = tree_.parent(*at);
      if (above == model::kNoNodeIndex) continue;
      below_[above].add(below_[*at].least);
      below_[above].add(below_[*at].greatest);
    }
  }

  // In the scene; empty: nothing is drawn there.
  model::Box box_of(std::uint32_t node, bool with_children) const {
    if (node >= tree_.size() || below_[node].empty()) return {};
    if (!with_children && !content_.side().views().nodes[node].mesh) return {};
    const model::Box box = with_children ? below_[node] : own_box(node);
    return box.diagonal() > 0 ? box : model::Box{};
  }

  model::Box box_of_curve(std::uint32_t animation, const std::vector<std::string>& steps) const {
    model::Box box;
    const model::Animation& all = content_.side().views().animations[animation];
    const bool all_of_it = steps.size() < 4;
    const std::uint32_t place = all_of_it ? kNoItem : index_in(steps[3]).value_or(kNoItem);
    for (std::uint32_t i = 0; i < all.channels.size(); ++i) {
      const model::AnimationChannel& channel = all.channels[i];
      const bool meant =
          all_of_it || (steps[2] == "channels" ? i : channel.sampler.value_or(kNoItem)) == place;
      if (!meant || !channel.node) continue;
      const model::Box moved = box_of(*channel.node, true);
      if (moved.empty()) continue;
      box.add(moved.least);
      box.add(moved.greatest);
      if (!all_of_it) break;
    }
    return box;
  }

  // Of the largest node, so that a picture of it shows the object well.
  model::Box box_of_users(ItemId item) {
    const auto [known, is_new] = boxes_.try_emplace(key_of(item));
    if (!is_new) return known->second;
    std::vector<ItemId> open{item};
    std::unordered_map<std::uint64_t, bool> seen{{key_of(item), true}};
    model::Box largest;
    while (!open.empty()) {
      const ItemId next = open.back();
      open.pop_back();
      if (next.list == nodes_) {
        const model::Box box = box_of(next.index, false);
        if (box.diagonal() > largest.diagonal()) largest = box;
        continue;
      }
      for (const ItemId& user : users_[key_of(next)]) {
        if (seen.try_emplace(key_of(user), true).second) open.push_back(user);
      }
    }
    return boxes_[key_of(item)] = largest;
  }

  const Content& content_;
  const NodeTree& tree_;
  const std::vector<model::Affine>& worlds_;
  const std::uint32_t nodes_;
  std::vector<model::Box> below_;  ///< by node: of it and its children
  std::unordered_map<std::uint64_t, std::vector<ItemId>> users_;
  std::unordered_map<std::uint64_t, model::Box> boxes_;  ///< of objects other than nodes
};

// The nodes of an asset at the moment of a change.
std::vector<model::Affine> posed_worlds(const Side& side, const std::optional<std::string>& pointer,
                                        double time) {
  const auto steps = pointer ? split_pointer(*pointer) : std::nullopt;
  const auto index = steps && steps->size() > 1 ? index_in((*steps)[1]) : std::nullopt;
  if (!index || *index >= side.views().animations.size()) return {};
  const auto sampled = model::sample_animation(side.asset(), side.views(), side.resources(),
                                               side.graph().set(), *index, time);
  return model::compute_pose(side.asset(), side.views(),
                             model::choose_scene(side.asset(), side.views()), sampled.values)
      .world;
}

// How much of the bound a change takes; without a measure, as much as any.
double weight_of(const Change& change) {
  return change.measure && change.measure->bound > 0 ? share_of_bound(change) : 1;
}

/// Lines and columns of one text.
class PlacesInText {
 public:
  PlacesInText(const Side& side, std::uint64_t offset)
      : side_(side), lines_(side.document().text()), offset_(offset) {}

  Location find(const std::optional<std::string>& pointer) const {
    if (!pointer) return {};
    const graph::Place place = side_.tree().find(*pointer);
    if (place.node == json::kNoNode) return {};
    return lines_.locate(side_.document().span(place.node), offset_);
  }

 private:
  const Side& side_;
  json::LineIndex lines_;
  std::uint64_t offset_;
};

}  // namespace

bool is_greater(const Change& a, const Change& b) {
  if (a.level != b.level) return a.level > b.level;
  return weight_of(a) > weight_of(b);
}

const Change* change_of_moment(const CompareReport& report) {
  const Change* greatest = nullptr;
  for (const Change& change : report.changes) {
    if (!change.time || !change.old_pointer || !change.new_pointer) continue;
    if (greatest == nullptr || is_greater(change, *greatest)) greatest = &change;
  }
  return greatest;
}

void locate_changes(const Comparison& all, std::uint64_t our_offset, std::uint64_t their_offset,
                    CompareReport& report) {
  if (report.changes.empty()) return;
  const PlacesInText ours(all.ours.side(), our_offset);
  const PlacesInText theirs(all.theirs.side(), their_offset);
  for (Change& change : report.changes) {
    change.old_location = ours.find(change.old_pointer);
    change.new_location = theirs.find(change.new_pointer);
  }
}

std::vector<ChangedBoxes> find_changed_boxes(const Comparison& all, const CompareReport& report) {
  std::vector<ChangedBoxes> boxes(std::min(report.changes.size(), kMostBoxes));
  std::vector<model::Affine> our_worlds, their_worlds;
  if (const Change* moment = change_of_moment(report)) {
    our_worlds = posed_worlds(all.ours.side(), moment->old_pointer, *moment->time);
    their_worlds = posed_worlds(all.theirs.side(), moment->new_pointer, *moment->time);
  }
  ShownBoxes ours(all.ours, all.our_nodes, our_worlds);
  ShownBoxes theirs(all.theirs, all.their_nodes, their_worlds);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Change& change = report.changes[i];
    if (change.old_pointer) boxes[i].ours = ours.box(*change.old_pointer);
    if (change.new_pointer) boxes[i].theirs = theirs.box(*change.new_pointer);
  }
  return boxes;
}

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <unordered_set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "prove/compare_values.hpp"
#include "prove/drawn_items.hpp"
#include "prove/hash_sum.hpp"

namespace gltfx::prove {
namespace {

/// One of the two assets, to be asked for what the other one lacks.
struct Half {
  const Content& content;
  const NodeTree& nodes;
  const std::set<std::uint32_t>& helpers;
  bool ours = true;
};

ItemId partner(const Comparison& all, const Half& half, ItemId item) {
  return half.ours ? all.match.theirs(item) : all.match.ours(item);
}

// Nothing but a transform and a mesh.
bool only_carries(const Content& content, const Item& node) {
  const json::Document& document = content.side().document();
  for (const auto member : document.members(node.node)) {
    const std::string_view name = document.key(member.key_id);
    if (name != "mesh" && name != "matrix" && name != "translation" && name != "rotation" &&
        name != "scale") {
      return false;
    }
  }
  return true;
}

void find_helpers_of(const Comparison& all, const Half& half, std::vector<std::uint32_t>& by_node,
                     std::set<std::uint32_t>& found) {
  const std::uint32_t list = half.content.list("/nodes");
  by_node.assign(half.nodes.size(), kNoItem);
  if (list == kNoItem) return;
  const auto& here = half.content.side().views().nodes;
  const auto& there = (half.ours ? all.theirs : all.ours).side().views().nodes;
  for (std::uint32_t node = 0; node < half.nodes.size(); ++node) {
    const model::NodeIndex above = half.nodes.parent(node);
    if (above == model::kNoNodeIndex || !here[node].mesh || here[above].mesh) continue;
    if (partner(all, half, {list, node}) || by_node[above] != kNoItem) continue;
    const ItemId other = partner(all, half, {list, above});
    if (!other || !there[other.index].mesh) continue;
    if (!only_carries(half.content, half.content.item({list, node}))) continue;
    by_node[above] = node;
    found.insert(node);
  }
}

enum class ItemUse : std::uint8_t { none, by_lost, by_kept };

/// By list and item: whether an item that has a partner refers to it, or only others.
std::vector<std::vector<ItemUse>> find_uses(const Comparison& all, const Half& half) {
  std::vector<std::vector<ItemUse>> uses;
  for (const ItemList& list : half.content.lists()) {
    uses.emplace_back(list.items.size(), ItemUse::none);
  }
  for (std::uint32_t list = 0; list < uses.size(); ++list) {
    for (std::uint32_t i = 0; i < uses[list].size(); ++i) {
      const Item& item = half.content.item({list, i});
      const bool lost = !partner(all, half, {list, i});
      for (std::uint32_t k = item.first; k < item.last; ++k) {
        const ItemId target = half.content.leaves()[k].target;
        if (!target) continue;
        ItemUse& use = uses[target.list][target.index];
        use = std::max(use, lost ? ItemUse::by_lost : ItemUse::by_kept);
      }
    }
  }
  return uses;
}

Hash128 identity_of(const Item& item) { return hash_of_all(item.content, item.label); }

std::unordered_set<Hash128, HashHasher> identities(const Content& content,
                                                   std::string_view pointer) {
  std::unordered_set<Hash128, HashHasher> all;
  const std::uint32_t list = content.list(pointer);
  if (list == kNoItem) return all;
  for (const Item& item : content.lists()[list].items) all.insert(identity_of(item));
  return all;
}

// Of a list in an extension of the asset that the other one lacks: a value of the asset tells it.
bool is_lost_with_extension(const Comparison& all, const Half& half, std::string_view list) {
  constexpr std::string_view kExtensions = "/extensions/";
  if (!list.starts_with(kExtensions)) return false;
  list.remove_prefix(kExtensions.size());
  const Side& other = (half.ours ? all.theirs : all.ours).side();
  const json::NodeId extensions = other.document().find(other.document().root(), "extensions");
  if (extensions == json::kNoNode || !other.document().is_object(extensions)) return true;
  return other.document().find(extensions, list.substr(0, list.find('/'))) == json::kNoNode;
}

// Whether a node draws anything together with those below it that are gone with it.
bool shows_lost_node(const Comparison& all, const Half& half, std::uint32_t list,
                     std::uint32_t node) {
  const DrawnItems& drawn = *(half.ours ? all.our_drawn : all.their_drawn);
  std::vector<std::uint32_t> open{node};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    if (!drawn.shows(at)) continue;
    if (drawn.shows_itself(at)) return true;
    for (const std::uint32_t child : half.nodes.children(at)) {
      if (!partner(all, half, {list, child})) open.push_back(child);
    }
  }
  return false;
}

// Whether what is gone was drawn. Of other objects, those that use them tell it.
bool shows_lost(const Comparison& all, const Half& half, ItemId id) {
  if (!all.options.drawn) return false;
  const std::string& list = half.content.lists()[id.list].pointer;
  const DrawnItems& drawn = *(half.ours ? all.our_drawn : all.their_drawn);
  if (list == "/nodes") return shows_lost_node(all, half, id.list, id.index);
  if (list == "/scenes") {
    const std::vector<std::uint32_t> roots = nodes_of_scene(half.content, id);
    return std::any_of(roots.begin(), roots.end(),
                       [&](std::uint32_t node) { return drawn.shows(node); });
  }
  if (list != "/animations") return false;
  const auto& channels = half.content.side().views().animations[id.index].channels;
  return std::any_of(channels.begin(), channels.end(),
                     [&](const auto& channel) { return drawn.is_moved_by(channel); });
}

// Whether any of a list that is gone was drawn.
bool shows_lost_list(const Comparison& all, const Half& half, std::uint32_t list) {
  const auto count = static_cast<std::uint32_t>(half.content.lists()[list].items.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    if (shows_lost(all, half, {list, i})) return true;
  }
  return false;
}

// Whether only one asset has the list.
bool tell_lost_list(const Comparison& all, const Half& half, std::uint32_t list) {
  const ItemList& lost = half.content.lists()[list];
  if (is_lost_with_extension(all, half, lost.pointer)) return true;
  const Content& other = half.ours ? all.theirs : all.ours;
  if (lost.items.size() < 2 || other.list(lost.pointer) != kNoItem) return false;
  const json::Document& document = half.content.side().document();
  const json::NodeId array = half.content.side().tree().parent(lost.items.front().node);
  if (array == json::kNoNode || !document.is_object(lost.items.front().node)) return false;
  Change change;
  change.kind = kind_of(lost.pointer, half.ours ? "removed" : "added");
  (half.ours ? change.old_pointer : change.new_pointer) = half.content.side().pointer(array);
  constexpr std::uint32_t kMostNames = 3;
  std::string names;
  for (std::uint32_t i = 0; i < std::min<std::size_t>(lost.items.size(), kMostNames); ++i) {
    names += (i == 0 ? "" : ", ") + Comparison::called(half.content, {list, i});
  }
  change.what = fmt::format("all {} objects of the list were {}: {}{}", lost.items.size(),
                            half.ours ? "removed" : "added", names,
                            lost.items.size() > kMostNames ? " and so on" : "");
  all.log.add(std::move(change), shows_lost_list(all, half, list));
  return true;
}

void tell_lost(const Comparison& all, const Half& half) {
  const auto uses = find_uses(all, half);
  const std::uint32_t nodes = half.content.list("/nodes");
  const Content& other = half.ours ? all.theirs : all.ours;
  for (std::uint32_t list = 0; list < uses.size(); ++list) {
    const std::string& pointer = half.content.lists()[list].pointer;
    if (tell_lost_list(all, half, list)) continue;
    const auto others = identities(other, pointer);
    for (std::uint32_t i = 0; i < uses[list].size(); ++i) {
      const ItemId id{list, i};
      if (partner(all, half, id)) continue;
      if (list == nodes) {
        const model::NodeIndex above = half.nodes.parent(i);
        if (half.helpers.contains(i)) continue;
        if (above != model::kNoNodeIndex && !partner(all, half, {nodes, above})) continue;
      } else if (uses[list][i] == ItemUse::by_lost) {
        continue;  // it came or went with its user
      }
      const Item& item = half.content.item(id);
      const bool repeated = list != nodes && others.contains(identity_of(item));
      if (repeated && pointer == "/textures") {
        all.log.note_storage("equal textures are stored once, or several times");
        continue;
      }
      Change change;
      change.kind = kind_of(pointer, half.ours ? "removed" : "added");
      change.name = Comparison::name(half.content, id);
      (half.ours ? change.old_pointer : change.new_pointer) =
          half.content.side().pointer(item.node);
      const std::string_view fate = half.ours ? "removed" : "added";
      change.what = change.name.empty() ? fmt::format("the {} was {}", subject_of(pointer), fate)
                                        : fmt::format("was {}", fate);
      if (repeated) change.what += "; an equal one remains";
      all.log.add(std::move(change), shows_lost(all, half, id));
    }
  }
}

}  // namespace

Helpers find_helpers(const Comparison& all) {
  Helpers helpers;
  const std::set<std::uint32_t> none;
  find_helpers_of(all, {all.ours, all.our_nodes, none, true}, helpers.ours, helpers.our_nodes);
  find_helpers_of(all, {all.theirs, all.their_nodes, none, false}, helpers.theirs,
                  helpers.their_nodes);
  return helpers;
}

void compare_presence(const Comparison& all, const Helpers& helpers) {
  tell_lost(all, {all.ours, all.our_nodes, helpers.our_nodes, true});
  tell_lost(all, {all.theirs, all.their_nodes, helpers.their_nodes, false});
}

}  // namespace gltfx::prove

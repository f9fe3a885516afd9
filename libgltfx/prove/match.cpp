// SPDX-License-Identifier: Apache-2.0
#include "prove/match.hpp"

#include <algorithm>
#include <span>
#include <unordered_map>

#include "model/pose.hpp"
#include "prove/hash_sum.hpp"

namespace gltfx::prove {
namespace {

bool is_zero(const Hash128& hash) { return hash == Hash128{}; }

/// An item that takes part in a pass.
struct Keyed {
  Hash128 key;
  bool theirs = false;
  std::uint32_t index = 0;
};

bool keyed_less(const Keyed& a, const Keyed& b) {
  if (a.key != b.key) return hash_less(a.key, b.key);
  return a.theirs != b.theirs ? b.theirs : a.index < b.index;
}

using IndexPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// Pairs items of one key: those with the same number first, the others in order.
void pair_equal(std::span<const Keyed> ours, std::span<const Keyed> theirs, IndexPairs& found) {
  std::vector<std::uint32_t> here, there;
  std::size_t i = 0, k = 0;
  while (i < ours.size() || k < theirs.size()) {
    const bool only_ours =
        k == theirs.size() || (i < ours.size() && ours[i].index < theirs[k].index);
    const bool only_theirs =
        i == ours.size() || (k < theirs.size() && theirs[k].index < ours[i].index);
    if (only_ours) {
      here.push_back(ours[i++].index);
    } else if (only_theirs) {
      there.push_back(theirs[k++].index);
    } else {
      found.emplace_back(ours[i++].index, theirs[k++].index);
    }
  }
  for (std::size_t at = 0; at < std::min(here.size(), there.size()); ++at) {
    found.emplace_back(here[at], there[at]);
  }
}

}  // namespace

Matching::Matching(const Content& ours, const NodeTree& our_nodes, const Content& theirs,
                   const NodeTree& their_nodes, bool names_count)
    : a_(ours),
      b_(theirs),
      our_nodes_(our_nodes),
      their_nodes_(their_nodes),
      names_count_(names_count),
      node_lists_{ours.list("/nodes"), theirs.list("/nodes")},
      our_lists_(theirs.lists().size(), kNoItem) {
  for (std::uint32_t list = 0; list < ours.lists().size(); ++list) {
    const std::uint32_t other = theirs.list(ours.lists()[list].pointer);
    their_lists_.push_back(other);
    partners_.theirs.emplace_back(ours.lists()[list].items.size(), kNoItem);
    if (other != kNoItem) our_lists_[other] = list;
  }
  for (const ItemList& list : theirs.lists())
    partners_.ours.emplace_back(list.items.size(), kNoItem);
  for (std::uint32_t list = 0; list < their_lists_.size(); ++list) {
    if (their_lists_[list] == kNoItem) continue;
    if (list == node_lists_.ours) {
      match_nodes(list);
    } else {
      if (!names_count_ && ours.lists()[list].pointer == "/scenes") pair_shown_scenes(list);
      match_list(list);
    }
  }
  follow_all();
  pair_leftovers();
  state_.any_mesh = true;
  follow_all();
  for (const auto& [one, other] : pairs_) state_.renumbered |= one.index != other.index;
}

ItemId Matching::theirs(ItemId ours) const {
  if (!ours) return {};
  const std::uint32_t index = partners_.theirs[ours.list][ours.index];
  return index == kNoItem ? ItemId{} : ItemId{their_lists_[ours.list], index};
}

ItemId Matching::ours(ItemId theirs) const {
  if (!theirs) return {};
  const std::uint32_t index = partners_.ours[theirs.list][theirs.index];
  return index == kNoItem ? ItemId{} : ItemId{our_lists_[theirs.list], index};
}

bool Matching::same(ItemId ours, ItemId theirs) const {
  if (!ours || !theirs) return !ours && !theirs;
  if (their_lists_[ours.list] != theirs.list) return false;
  if (partners_.theirs[ours.list][ours.index] == theirs.index) return true;
  const std::string& pointer = a_.lists()[ours.list].pointer;
  if (pointer == "/nodes" || pointer == "/scenes" || pointer == "/animations" ||
      pointer == "/skins") {
    return false;
  }
  const Item& one = a_.item(ours);
  const Item& other = b_.item(theirs);
  return one.content == other.content && (!names_count_ || one.label == other.label);
}

void Matching::pair(ItemId ours, ItemId theirs) {
  partners_.theirs[ours.list][ours.index] = theirs.index;
  partners_.ours[theirs.list][theirs.index] = ours.index;
  pairs_.emplace_back(ours, theirs);
}

void Matching::join(std::uint32_t list, const Key& ours, const Key& theirs, bool unique) {
  const std::uint32_t other = their_lists_[list];
  std::vector<Keyed> keyed;
  const auto add = [&](std::uint32_t of, const std::vector<std::uint32_t>& partners, const Key& key,
                       bool is_theirs) {
    for (std::uint32_t i = 0; i < partners.size(); ++i) {
      if (partners[i] != kNoItem) continue;
      const Hash128 hash = key({of, i});
      if (!is_zero(hash)) keyed.push_back({hash, is_theirs, i});
    }
  };
  add(list, partners_.theirs[list], ours, false);
  add(other, partners_.ours[other], theirs, true);
  std::sort(keyed.begin(), keyed.end(), keyed_less);
  IndexPairs found;
  for (std::size_t begin = 0; begin < keyed.size();) {
    std::size_t middle = begin;
    while (middle < keyed.size() && keyed[middle].key == keyed[begin].key &&
           !keyed[middle].theirs) {
      ++middle;
    }
    std::size_t end = middle;
    while (end < keyed.size() && keyed[end].key == keyed[begin].key) ++end;
    if (!unique || (middle - begin == 1 && end - middle == 1)) {
      const std::span all(keyed);
      pair_equal(all.subspan(begin, middle - begin), all.subspan(middle, end - middle), found);
    }
    begin = end;
  }
  std::sort(found.begin(), found.end());
  for (const auto& [one, two] : found) pair({list, one}, {other, two});
}

// Where names do not count, the scene that is shown first belongs to the one of the other asset.
void Matching::pair_shown_scenes(std::uint32_t list) {
  const auto shown = [](const Content& content) {
    return model::choose_scene(content.side().asset(), content.side().views()).scene;
  };
  const auto one = shown(a_);
  const auto other = shown(b_);
  if (one && other) pair({list, *one}, {their_lists_[list], *other});
}

void Matching::match_list(std::uint32_t list) {
  const auto both = [](const Content& content) {
    return [&content](ItemId id) {
      return hash_of_all(content.item(id).content, content.item(id).label);
    };
  };
  const auto label = [](const Content& content) {
    return [&content](ItemId id) { return content.item(id).label; };
  };
  const auto content = [](const Content& of) {
    return [&of](ItemId id) { return of.item(id).content; };
  };
  const auto own = [](const Content& of) { return [&of](ItemId id) { return of.item(id).own; }; };
  join(list, both(a_), both(b_));
  match_renamed(list);
  join(list, label(a_), label(b_), true);
  join(list, label(a_), label(b_));
  join(list, content(a_), content(b_));
  join(list, own(a_), own(b_), true);
}

// Names may go from one object to another: an object at its place in the list whose content no
// other one has is the same under another name.
void Matching::match_renamed(std::uint32_t list) {
  const std::uint32_t other = their_lists_[list];
  const std::vector<Item>& here = a_.lists()[list].items;
  const std::vector<Item>& there = b_.lists()[other].items;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < std::min(here.size(), there.size()); ++i) {
    const bool free = partners_.theirs[list][i] == kNoItem && partners_.ours[other][i] == kNoItem;
    if (free && here[i].content == there[i].content && are_strangers({list, i}, {other, i})) {
      found.push_back(i);
    }
  }
  if (found.empty()) return;
  std::unordered_map<Hash128, std::uint32_t, HashHasher> times;
  for (const Item& item : here) ++times[item.content];
  for (const Item& item : there) ++times[item.content];
  for (const std::uint32_t i : found) {
    if (times[here[i].content] == 2) pair({list, i}, {other, i});
  }
}

Hash128 Matching::parent_key(ItemId ours) const {
  const model::NodeIndex above = our_nodes_.parent(ours.index);
  if (above == model::kNoNodeIndex) return hash_of_all('r');
  if (partners_.theirs[node_lists_.ours][above] == kNoItem) return {};
  return hash_of_all('p', above);
}

Hash128 Matching::their_parent_key(ItemId theirs) const {
  const model::NodeIndex above = their_nodes_.parent(theirs.index);
  if (above == model::kNoNodeIndex) return hash_of_all('r');
  const std::uint32_t ours = partners_.ours[node_lists_.theirs][above];
  return ours == kNoItem ? Hash128{} : hash_of_all('p', ours);
}

void Matching::match_nodes(std::uint32_t list) {
  // A key that also has the parent, in pairs of parents that are known.
  const auto join_below = [&](const Key& ours, const Key& theirs, bool unique = false) {
    join(
        list,
        [&](ItemId id) {
          const Hash128 above = parent_key(id);
          const Hash128 key = ours(id);
          return is_zero(above) || is_zero(key) ? Hash128{} : hash_of_all(above, key);
        },
        [&](ItemId id) {
          const Hash128 above = their_parent_key(id);
          const Hash128 key = theirs(id);
          return is_zero(above) || is_zero(key) ? Hash128{} : hash_of_all(above, key);
        },
        unique);
  };
  const auto key = [](const Content& of, const NodeTree* places, bool content, bool label) {
    return [&of, places, content, label](ItemId id) {
      const Item& item = of.item(id);
      if (!content && is_zero(item.label)) return Hash128{};
      return hash_of_all(content ? item.content : Hash128{}, label ? item.label : Hash128{},
                         places != nullptr ? places->place(id.index) : Hash128{});
    };
  };
  join(list, key(a_, &our_nodes_, true, true), key(b_, &their_nodes_, true, true));
  match_renamed(list);
  join(list, key(a_, nullptr, false, true), key(b_, nullptr, false, true), true);
  join_below(key(a_, nullptr, true, true), key(b_, nullptr, true, true));
  join(list, key(a_, nullptr, true, true), key(b_, nullptr, true, true));
  join_below(key(a_, nullptr, false, true), key(b_, nullptr, false, true));
  join(list, key(a_, nullptr, false, true), key(b_, nullptr, false, true), true);
  join_below(key(a_, nullptr, true, false), key(b_, nullptr, true, false));
  join(list, key(a_, nullptr, true, false), key(b_, nullptr, true, false), true);
  const auto own = [](const Content& of) { return [&of](ItemId id) { return of.item(id).own; }; };
  join_below(own(a_), own(b_), true);
}

// Whether both have names that count and are different.
bool Matching::are_strangers(ItemId ours, ItemId theirs) const {
  if (!names_count_) return false;
  const Hash128& one = a_.item(ours).label;
  const Hash128& other = b_.item(theirs).label;
  return !is_zero(one) && !is_zero(other) && one != other;
}

void Matching::follow_all() {
  pair_children(our_nodes_.roots(), their_nodes_.roots());
  for (std::size_t i = state_.any_mesh ? 0 : followed_; i < pairs_.size(); ++i) {
    const auto [ours, theirs] = pairs_[i];
    if (i >= followed_) {
      follow(ours, theirs);
    } else if (ours.list == node_lists_.ours) {
      pair_children(our_nodes_.children(ours.index), their_nodes_.children(theirs.index));
    }
  }
  followed_ = pairs_.size();
}

// Pairs what two objects refer to from the same place.
void Matching::follow(ItemId ours, ItemId theirs) {
  struct Targets {
    std::vector<ItemId> all;
    std::size_t next = 0;
  };
  std::unordered_map<Hash128, Targets, HashHasher> there;
  const Item& one = a_.item(ours);
  // Most objects refer to none that is left.
  bool any = false;
  for (std::uint32_t i = one.first; i < one.last && !any; ++i) {
    const ItemId target = a_.leaves()[i].target;
    any = target && !this->theirs(target);
  }
  const Item other = any ? b_.item(theirs) : Item{};
  for (std::uint32_t i = other.first; i < other.last; ++i) {
    const Leaf& leaf = b_.leaves()[i];
    if (leaf.target && !this->ours(leaf.target)) there[leaf.path].all.push_back(leaf.target);
  }
  for (std::uint32_t i = one.first; i < one.last && !there.empty(); ++i) {
    const Leaf& leaf = a_.leaves()[i];
    if (!leaf.target || this->theirs(leaf.target)) continue;
    const auto found = there.find(leaf.path);
    if (found == there.end()) continue;
    Targets& targets = found->second;
    while (targets.next < targets.all.size() && this->ours(targets.all[targets.next])) {
      ++targets.next;
    }
    if (targets.next == targets.all.size()) continue;
    const ItemId target = targets.all[targets.next];
    if (their_lists_[leaf.target.list] != target.list) continue;
    if (are_strangers(leaf.target, target)) continue;
    ++targets.next;
    pair(leaf.target, target);
  }
  if (ours.list != node_lists_.ours) return;
  pair_children(our_nodes_.children(ours.index), their_nodes_.children(theirs.index));
}

// Pairs nodes that are left over, with the same mesh first, then in order.
void Matching::pair_children(const std::vector<std::uint32_t>& ours,
                             const std::vector<std::uint32_t>& theirs) {
  if (node_lists_.ours == kNoItem || node_lists_.theirs == kNoItem) return;
  const auto left = [](const std::vector<std::uint32_t>& all,
                       const std::vector<std::uint32_t>& partners) {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t node : all) {
      if (partners[node] == kNoItem) nodes.push_back(node);
    }
    return nodes;
  };
  std::vector<std::uint32_t> here = left(ours, partners_.theirs[node_lists_.ours]);
  std::vector<std::uint32_t> there = left(theirs, partners_.ours[node_lists_.theirs]);
  if (here.empty() || there.empty()) return;
  if (state_.any_mesh && here.size() != there.size()) return;
  const std::uint32_t meshes = a_.list("/meshes");
  const std::uint32_t their_meshes = b_.list("/meshes");
  const auto our_mesh = [&](std::uint32_t node) -> std::uint64_t {
    const auto& mesh = a_.side().views().nodes[node].mesh;
    if (!mesh || state_.any_mesh) return UINT64_MAX;
    const ItemId partner = this->theirs({meshes, *mesh});
    return partner ? partner.index : UINT64_MAX - 1;
  };
  const auto their_mesh = [&](std::uint32_t node) -> std::uint64_t {
    const auto& mesh = b_.side().views().nodes[node].mesh;
    if (!mesh || state_.any_mesh) return UINT64_MAX;
    return this->ours({their_meshes, *mesh}) ? *mesh : UINT64_MAX - 1;
  };
  std::unordered_map<std::uint64_t, std::pair<std::vector<std::uint32_t>, std::size_t>> by_mesh;
  for (const std::uint32_t node : there) by_mesh[their_mesh(node)].first.push_back(node);
  for (const std::uint32_t node : here) {
    const auto found = by_mesh.find(our_mesh(node));
    if (found == by_mesh.end() || found->second.second == found->second.first.size()) continue;
    const ItemId one{node_lists_.ours, node};
    const ItemId other{node_lists_.theirs, found->second.first[found->second.second]};
    if (are_strangers(one, other)) continue;
    ++found->second.second;
    pair(one, other);
  }
}

// Objects without names that nothing tells apart, if both assets have as many of them.
void Matching::pair_leftovers() {
  for (std::uint32_t list = 0; list < their_lists_.size(); ++list) {
    const std::uint32_t other = their_lists_[list];
    if (other == kNoItem || list == node_lists_.ours) continue;
    std::vector<std::uint32_t> here, there;
    for (std::uint32_t i = 0; i < partners_.theirs[list].size(); ++i) {
      if (partners_.theirs[list][i] == kNoItem) here.push_back(i);
    }
    for (std::uint32_t i = 0; i < partners_.ours[other].size(); ++i) {
      if (partners_.ours[other][i] == kNoItem) there.push_back(i);
    }
    if (here.size() != there.size()) continue;
    for (std::size_t i = 0; i < here.size(); ++i) {
      const ItemId one{list, here[i]};
      const ItemId two{other, there[i]};
      if (!are_strangers(one, two)) pair(one, two);
    }
  }
}

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
/// Which object of one asset became which of the other.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "prove/content.hpp"
#include "prove/node_tree.hpp"

namespace gltfx::prove {

/// Objects are matched by content, name and place, then by what matched objects refer to. Each pass
/// joins what is left by sorting equal keys; of equal keys, in the order of the lists. Results do
/// not depend on hashes or threads, and exchange with the assets. n log n.
class Matching {
 public:
  /// `names_count`: whether objects of equal content and different names are different.
  Matching(const Content& ours, const NodeTree& our_nodes, const Content& theirs,
           const NodeTree& their_nodes, bool names_count);

  /// The list of the other asset with the same pointer, or kNoItem.
  std::uint32_t their_list(std::uint32_t ours) const { return their_lists_[ours]; }
  std::uint32_t our_list(std::uint32_t theirs) const { return our_lists_[theirs]; }
  /// The partner, or an empty id.
  ItemId theirs(ItemId ours) const;
  ItemId ours(ItemId theirs) const;
  /// Whether references to both have the same meaning: they are partners, or have equal contents
  /// and, unlike nodes, no identity.
  bool same(ItemId ours, ItemId theirs) const;
  /// Whether objects have another order than before.
  bool is_renumbered() const { return state_.renumbered; }

 private:
  /// The key of an item for one pass; zeros: it takes no part.
  using Key = std::function<Hash128(ItemId)>;
  void pair_shown_scenes(std::uint32_t list);
  void match_list(std::uint32_t list);
  void match_nodes(std::uint32_t list);
  void match_renamed(std::uint32_t list);
  void join(std::uint32_t list, const Key& ours, const Key& theirs, bool unique = false);
  void pair(ItemId ours, ItemId theirs);
  void follow_all();
  void follow(ItemId ours, ItemId theirs);
  void pair_children(const std::vector<std::uint32_t>& ours,
                     const std::vector<std::uint32_t>& theirs);
  void pair_leftovers();
  bool are_strangers(ItemId ours, ItemId theirs) const;
  Hash128 parent_key(ItemId ours) const;
  Hash128 their_parent_key(ItemId theirs) const;

  const Content& a_;
  const Content& b_;
  const NodeTree& our_nodes_;
  const NodeTree& their_nodes_;
  const bool names_count_;
  struct {
    std::uint32_t ours = kNoItem, theirs = kNoItem;
  } node_lists_;
  std::vector<std::uint32_t> their_lists_, our_lists_;
  /// By list and index.
  struct {
    std::vector<std::vector<std::uint32_t>> theirs, ours;
  } partners_;
  std::vector<std::pair<ItemId, ItemId>> pairs_;
  std::size_t followed_ = 0;
  struct {
    bool any_mesh = false;  ///< nodes with other meshes may be partners: nothing else is left
    bool renumbered = false;
  } state_;
};

}  // namespace gltfx::prove

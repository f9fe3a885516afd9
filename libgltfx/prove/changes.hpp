// SPDX-License-Identifier: Apache-2.0
/// Collects what changed between two assets, and the kinds of change.
#pragma once

#include <gltfx/compare.hpp>

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "prove/match.hpp"
#include "prove/texture_use.hpp"

namespace gltfx::prove {

class DrawnItems;

/// The changes of one comparison: each once, and only those that count.
class ChangeLog {
 public:
  explicit ChangeLog(const CompareOptions& options) : options_(options) {}

  /// Precondition: the kind is one of change_kinds(). `shows`: it is drawn even if other changes of
  /// the kind are not.
  void add(Change change, bool shows = false);
  /// What is stored differently, half a sentence; once each.
  void note_storage(std::string what);
  /// A reference leads to another object than before, with equal contents.
  void note_equal(const std::string& pointer);
  /// What cannot be compared, a sentence; once each.
  void leave_out(std::string what);

  /// Removes the changes for which the function is true.
  void forget(const std::function<bool(const Change&)>& gone);
  /// Changes for which the function gives the same text, not an empty one, become one: the greatest
  /// of them, with the pointers of the others.
  void merge(const std::function<std::string(Change&)>& cause_of);
  bool differs() const;
  /// All so far.
  const std::vector<Change>& changes() const { return changes_; }

  /// Sets level, changes, storage and unproven. The level is `storage` without a change.
  void take(CompareReport& report);

 private:
  void merge_within_bounds();

  const CompareOptions& options_;
  std::set<std::string> told_, stored_, left_out_, equal_;
  std::vector<Change> changes_;
};

/// Whether changes of a kind are drawn: whether they count with CompareOptions::drawn.
bool is_drawn(std::string_view kind);

/// "material" for "/materials"; "object" for a list of an extension.
std::string_view subject_of(std::string_view list);
/// The part of its bound that a change takes; 0: it has none.
double share_of_bound(const Change& change);

/// The name of the kind: kind_of("/materials", "added"). Static storage.
std::string_view kind_of(std::string_view list, std::string_view what);

/// The two assets of a comparison with all that was found out about them.
struct Comparison {
  const Content& ours;
  const Content& theirs;
  const NodeTree& our_nodes;
  const NodeTree& their_nodes;
  const Matching& match;
  const CompareOptions& options;
  ChangeLog& log;
  const std::vector<TextureUse>& texture_uses;  ///< of the old asset
  double diagonal = 0;                          ///< the smaller one of both scenes
  /// With CompareOptions::drawn only.
  const DrawnItems* our_drawn = nullptr;
  const DrawnItems* their_drawn = nullptr;  ///< likewise

  std::string our_name(ItemId item) const { return name(ours, item); }
  std::string their_name(ItemId item) const { return name(theirs, item); }
  static std::string name(const Content& content, ItemId item);
  /// "'Red'", or its pointer: what a sentence calls an object.
  static std::string called(const Content& content, ItemId item);
  std::string our_pointer(ItemId item) const { return ours.side().pointer(ours.item(item).node); }
  std::string their_pointer(ItemId item) const {
    return theirs.side().pointer(theirs.item(item).node);
  }

  /// Calls `compare(ours, theirs)` for each object of a list ("/images") that has a partner.
  template <class F>
  void for_each_pair(std::string_view pointer, F compare) const {
    const std::uint32_t list = ours.list(pointer);
    if (list == kNoItem) return;
    for (std::uint32_t i = 0; i < ours.lists()[list].items.size(); ++i) {
      const ItemId item{list, i};
      if (const ItemId other = match.theirs(item)) compare(item, other);
    }
  }
};

/// The text of a value, cut.
std::string short_value(const json::Document& document, json::NodeId value);

}  // namespace gltfx::prove

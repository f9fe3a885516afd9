// SPDX-License-Identifier: Apache-2.0
#include "change/deletion.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "change/bin_cut.hpp"
#include "change/lost_content.hpp"
#include "change/name_list.hpp"
#include "change/removal_closure.hpp"
#include "graph/extras.hpp"
#include "graph/renumber.hpp"
#include "graph/unknown_indices.hpp"

namespace gltfx::change {
namespace {

using Reason = std::optional<std::string>;

class DeletionPlanner {
 public:
  DeletionPlanner(const json::Document& document, const schema::Set& set,
                  const DeletionOptions& options)
      : graph_(document, set),
        tree_(graph_.tree()),
        removals_(graph_, options.cascade),
        editor_(document),
        container_(options.container),
        integers_only_(options.integers_only) {}

  Result<Deletion> run(std::span<const std::string> pointers) {
    std::vector<Place> places;
    for (const std::string& pointer : pointers) {
      const Place place = tree_.find(pointer);
      if (place.node == json::kNoNode) return Error{gltfx::quoted(pointer) + " leads nowhere"};
      places.push_back(place);
    }
    if (auto why = removals_.remove(places)) return Error{*std::move(why)};
    removed_ = removals_.outermost();
    for (const Removed& removed : removed_) nodes_.push_back(removed.place.node);
    std::sort(nodes_.begin(), nodes_.end());
    list_deleted();
    for (const Obstacle& obstacle : removals_.obstacles()) {
      deletion_.obstacles.push_back(
          {tree_.pointer(obstacle.at), tree_.pointer(obstacle.target), obstacle.owner});
    }
    if (!deletion_.obstacles.empty()) return std::move(deletion_);
    collect_shifts();
    if (auto why = find_doubt()) return Error{*std::move(why)};
    take_out();
    renumber();
    if (auto why = resolve_bins()) return Error{*std::move(why)};
    if (auto why = remove_names()) return Error{*std::move(why)};
    note_doubtful();
    deletion_.change.edits = editor_.take();
    return std::move(deletion_);
  }

 private:
  const json::Document& document() const { return tree_.document(); }

  void list_deleted() {
    for (const Removed& removed : removed_) {
      const bool asked = removed.cause.node == json::kNoNode;
      deletion_.deleted.push_back(
          {tree_.pointer(removed.place), asked ? std::string() : tree_.pointer(removed.cause)});
    }
  }

  void collect_shifts() {
    for (const Removed& removed : removed_) {
      if (removed.place.element || tree_.is_member(removed.place.node)) continue;
      shifts_[tree_.parent(removed.place.node)].push_back(tree_.position(removed.place.node));
    }
    for (auto& [list, positions] : shifts_) std::sort(positions.begin(), positions.end());
  }

  // The new index of the element of a list.
  std::uint64_t shifted(json::NodeId list, std::uint64_t index) const {
    const auto found = shifts_.find(list);
    if (found == shifts_.end()) return index;
    const auto& gone = found->second;
    const auto behind = std::lower_bound(gone.begin(), gone.end(), index);
    return index - static_cast<std::uint64_t>(behind - gone.begin());
  }

  bool loses_something(json::NodeId value) const {
    const auto first = std::upper_bound(nodes_.begin(), nodes_.end(), value);
    return first != nodes_.end() && *first < document().next(value);
  }

  // Why the graph may not have all references, or nothing.
  Reason find_doubt() const {
    for (const json::NodeId object : graph_.unknown_extensions()) {
      if (removals_.is_gone(object)) continue;
      if (integers_only_ && !graph::may_hold_index(document(), object)) continue;
      return unknown(tree_.name(object));
    }
    for (const graph::PointerText& pointer : graph_.pointers()) {
      const bool varies = pointer.varying != json::kNoNode && !removals_.is_gone(pointer.at);
      if (!varies || !loses_something(pointer.varying)) continue;
      return fmt::format("the target of the pointer at {} is set at run time",
                         printable(tree_.pointer(pointer.at)));
    }
    for (const graph::IndexUse& use : graph_.indices()) {
      const bool ambiguous = use.ambiguous != json::kNoNode && !removals_.is_gone(use.at);
      if (!ambiguous || !loses_something(use.ambiguous)) continue;
      return fmt::format("the target of {} is ambiguous", printable(tree_.pointer(use.at)));
    }
    for (const graph::Use& use : graph_.uses()) {
      if (use.kind != graph::UseKind::implied || removals_.is_gone(use.at)) continue;
      const std::uint64_t index = tree_.position(use.target);
      const bool stays =
          !removals_.is_gone(use.target) && shifted(tree_.parent(use.target), index) == index;
      if (stays) continue;
      return fmt::format("{} refers to {} by its default", printable(tree_.pointer(use.at)),
                         printable(tree_.pointer(use.target)));
    }
    return std::nullopt;
  }

  static std::string unknown(std::string_view extension) {
    return fmt::format("{} is unknown there and may contain indices", gltfx::quoted(extension));
  }

  void take_out() {
    for (const Removed& removed : removed_) {
      const json::NodeId node = removed.place.node;
      if (removed.place.element) {
        editor_.remove_number(node, static_cast<std::uint32_t>(*removed.place.element));
      } else {
        editor_.remove(tree_.parent(node), tree_.is_member(node) ? node - 1 : node);
      }
    }
  }

  void renumber() {
    auto edits = graph::renumber(
        graph_,
        [this](json::NodeId list, std::uint64_t position) { return shifted(list, position); },
        [this](Place at) { return removals_.is_gone(at); });
    for (json::Edit& edit : edits) editor_.replace_text(edit.span, std::move(edit.text));
    deletion_.renumbered = edits.size();
  }

  Reason resolve_bins() {
    if (container_ == nullptr) return std::nullopt;
    auto changes = cut_bins(
        graph_, *container_, [this](json::NodeId object) { return removals_.is_gone(object); },
        editor_);
    if (!changes) return changes.error().message;
    deletion_.change.bins = *std::move(changes);
    return std::nullopt;
  }

  // Removes names of extensions without objects. An unknown one that stays may affect anything.
  Reason remove_names() {
    std::vector<json::NodeId> values;
    for (const Removed& removed : removed_) {
      if (!removed.place.element) values.push_back(removed.place.node);
    }
    const auto names = extensions_taken_out(document(), values);
    std::set<std::string> gone;
    for (const char* member : {"extensionsUsed", "extensionsRequired"}) {
      const json::NodeId node = tree_.member(document().root(), member);
      if (node == json::kNoNode || loses_something(node) || removals_.is_gone(node)) continue;
      NameList list(document(), member);
      gone.merge(list.remove_all(names));
      for (std::uint64_t i = 0; i < tree_.size(node); ++i) {
        const json::NodeId each = tree_.element(node, i);
        if (each == json::kNoNode || !document().is_string(each)) continue;
        const std::string name = document().string(each);
        const bool known = graph_.set().find_extension(name) != schema::kNone;
        if (!integers_only_ && !known && names.count(name) == 0) return unknown(name);
      }
      list.apply(editor_);
    }
    deletion_.names.assign(gone.begin(), gone.end());
    return std::nullopt;
  }

  void note_doubtful() {
    for (const json::NodeId value : graph::likely_indices(
             document(), {"accessor", "animation", "buffer", "camera", "image", "index", "indices",
                          "joint", "light", "material", "mesh", "node", "primitive", "sampler",
                          "scene", "skin", "texture", "variant"})) {
      if (!removals_.is_gone(value)) deletion_.doubtful.push_back(tree_.pointer(value));
    }
  }

  const Graph graph_;
  const Tree& tree_;
  Removals removals_;
  json::Editor editor_;
  const container::Container* container_;
  const bool integers_only_;
  std::vector<Removed> removed_;
  std::vector<json::NodeId> nodes_;                                      ///< of removed_, sorted
  std::unordered_map<json::NodeId, std::vector<std::uint64_t>> shifts_;  ///< positions, by list
  Deletion deletion_;
};

}  // namespace

Result<Deletion> plan_deletion(const json::Document& document, const schema::Set& set,
                               std::span<const std::string> pointers,
                               const DeletionOptions& options) {
  return DeletionPlanner(document, set, options).run(pointers);
}

}  // namespace gltfx::change

// SPDX-License-Identifier: Apache-2.0
// Removes unused objects, which cannot be reached from the roots of an asset, and vertices that no
// index uses.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "change/deletion.hpp"
#include "report/wording.hpp"
#include "steps/prune_vertices.hpp"
#include "steps/references.hpp"
#include "steps/stages.hpp"

namespace gltfx::steps {
namespace {

using json::NodeId;

constexpr std::array<std::string_view, 8> kPrunedLists{
    "accessors", "bufferViews", "images", "materials", "meshes", "samplers", "skins", "textures"};
// Without scenes, an asset is a library of individual entities (glTF 2.0 section 3.5.1).
constexpr std::array<std::string_view, 5> kListsOfLibrary{"images", "materials", "meshes", "skins",
                                                          "textures"};

/// Finds elements of root arrays that cannot be reached.
class Unreached {
 public:
  explicit Unreached(const graph::Graph& graph)
      : graph_(graph), document_(graph.tree().document()) {
    for (const std::string_view name : kPrunedLists) {
      const NodeId list = document_.find(document_.root(), name);
      if (list != json::kNoNode && document_.kind(list) == json::Kind::array) add(list);
    }
    open_ = {document_.root()};
  }

  /// The elements, in document order. Adds notes to `row` about lists whose elements stay.
  std::vector<NodeId> find(ConvertStep& row) {
    expand();
    std::vector<NodeId> kept;
    for (const auto& [list, why] : lists_) {
      if (why.reason.empty() || unreached_in(list).empty()) continue;
      (why.is_refusal ? row.refused : row.left)
          .push_back({graph_.tree().pointer(list), why.reason});
      kept.push_back(list);
    }
    for (const NodeId list : kept) {
      for (const NodeId element : unreached_in(list)) reach(element);
    }
    expand();
    std::vector<NodeId> found;
    for (const auto& [list, why] : lists_) {
      const auto more = unreached_in(list);
      found.insert(found.end(), more.begin(), more.end());
    }
    return found;
  }

 private:
  struct Kept {
    std::string reason;  ///< empty: elements may be removed
    bool is_refusal = false;
  };

  void add(NodeId list) {
    Kept& kept = lists_[list];
    if (const auto doubt = find_index_doubt(graph_, list)) {
      kept = {*doubt, true};
      return;
    }
    const NodeId scenes = document_.find(document_.root(), "scenes");
    const bool has_scenes = scenes != json::kNoNode && document_.is_array(scenes);
    const std::string_view name = graph_.tree().name(list);
    if (has_scenes ||
        std::find(kListsOfLibrary.begin(), kListsOfLibrary.end(), name) == kListsOfLibrary.end()) {
      return;
    }
    kept.reason = "without scenes, the asset is a library";
  }

  void reach(NodeId element) {
    if (reached_.insert(element).second) open_.push_back(element);
  }

  void follow(const graph::Use& use) {
    const NodeId element = graph_.tree().root_element(use.target);
    if (element != json::kNoNode && lists_.contains(graph_.tree().parent(element))) reach(element);
  }

  // Follows references. At the root, skips the lists that are pruned.
  void expand() {
    for (; next_ < open_.size(); ++next_) {
      const NodeId from = open_[next_];
      if (from != document_.root()) {
        graph_.each_use_in(from, [this](const graph::Use& use) { follow(use); });
        continue;
      }
      for (const auto member : document_.members(from)) {
        if (lists_.contains(member.value)) continue;
        graph_.each_use_in(member.value, [this](const graph::Use& use) { follow(use); });
      }
    }
  }

  std::vector<NodeId> unreached_in(NodeId list) const {
    std::vector<NodeId> elements;
    for (const NodeId element : document_.elements(list)) {
      if (document_.is_object(element) && !reached_.contains(element)) elements.push_back(element);
    }
    return elements;
  }

  const graph::Graph& graph_;
  const json::Document& document_;
  std::map<NodeId, Kept> lists_;
  std::unordered_set<NodeId> reached_;
  std::vector<NodeId> open_;
  std::size_t next_ = 0;  ///< the first element of open_ that is not followed yet
};

class PruneRun {
 public:
  explicit PruneRun(const StepInput& input) : input_(input), stages_(input.asset) {}

  Result<StepOutcome> run() {
    if (auto error = remove_objects(outcome_.row)) return *error;
    if (is_safe_) {
      if (auto error = remove_vertices()) return *error;
    }
    outcome_.change = std::move(stages_.all());
    outcome_.freedom.unused = true;
    std::string& what = outcome_.row.what;
    if (objects_ > 0) what = report::counted(objects_, "object");
    if (vertices_ > 0) {
      what += fmt::format("{}{}", what.empty() ? "" : ", ",
                          vertices_ == 1 ? "1 vertex" : fmt::format("{} vertices", vertices_));
    }
    return std::move(outcome_);
  }

 private:
  std::optional<Error> change(change::Change change) {
    if (auto error = stages_.add(std::move(change))) return error;
    return stages_.apply();
  }

  // Adds notes about objects that stay to `notes`.
  std::optional<Error> remove_objects(ConvertStep& notes) {
    const graph::Graph graph(stages_.asset().document(), input_.schemas);
    const std::vector<NodeId> unused = Unreached(graph).find(notes);
    if (unused.empty()) return std::nullopt;
    const std::unordered_set<NodeId> gone(unused.begin(), unused.end());
    const auto unknown =
        find_unknown_index(graph, [&](NodeId element) { return gone.contains(element); });
    if (unknown) return refuse(*unknown);
    const std::size_t count = remove(graph, unused);
    if (count == 0 || !plan_) return std::nullopt;
    // Before the document of the graph is replaced.
    if (auto note = find_indices_in_extras(graph)) notes.left.push_back(*std::move(note));
    if (auto error = change(*std::move(plan_))) return error;
    objects_ += count;
    return std::nullopt;
  }

  std::nullopt_t refuse(ConvertNote note) {
    is_safe_ = false;
    outcome_.row.refused.push_back(std::move(note));
    return std::nullopt;
  }

  // Plans the deletion and returns the number of objects.
  std::size_t remove(const graph::Graph& graph, const std::vector<NodeId>& unused) {
    plan_.reset();
    std::vector<std::string> pointers;
    for (const NodeId element : unused) pointers.push_back(graph.tree().pointer(element));
    change::DeletionOptions options;
    options.integers_only = true;
    auto planned =
        change::plan_deletion(stages_.asset().document(), input_.schemas, pointers, options);
    if (!planned) {
      refuse({{}, planned.error().message});
    } else if (!planned->obstacles.empty()) {
      refuse({planned->obstacles.front().pointer, "refers to an object that nothing else uses"});
    } else {
      plan_ = std::move(planned->change);
    }
    return plan_ ? unused.size() : 0;
  }

  std::optional<Error> remove_vertices() {
    auto pruned = prune_vertices(
        {stages_.asset(), input_.schemas, input_.options, {}, input_.unread, input_.encodings},
        outcome_.row);
    if (!pruned) return pruned.error();
    vertices_ = pruned->vertices;
    if (vertices_ == 0) return std::nullopt;
    if (auto error = change(std::move(pruned->change))) return error;
    // Accessors may have moved to new views, so old views may be unused now.
    const std::uint64_t objects = objects_;
    ConvertStep known_notes;
    auto error = remove_objects(known_notes);
    objects_ = objects;
    return error;
  }

  const StepInput& input_;
  Stages stages_;
  StepOutcome outcome_;
  std::optional<change::Change> plan_;
  std::uint64_t objects_ = 0, vertices_ = 0;  ///< removed
  bool is_safe_ = true;
};

}  // namespace

StepDescription prune_step();
StepDescription prune_step() {
  return {"prune",
          "removes objects without references, and vertices that no index uses",
          "scenes, nodes, cameras, animations, vertex attributes, and everything that they use",
          "unused objects and vertices",
          [](const ConvertOptions& options) { return options.prune || options.shrink; },
          [](const StepInput& input) { return PruneRun(input).run(); }};
}

}  // namespace gltfx::steps

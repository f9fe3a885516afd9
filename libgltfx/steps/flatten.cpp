// SPDX-License-Identifier: Apache-2.0
// Copies external assets (glTF 2.1) into the asset that shows them.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "base/text.hpp"
#include "change/companions.hpp"
#include "change/name_list.hpp"
#include "json/parse.hpp"
#include "json/writer.hpp"
#include "model/asset.hpp"
#include "model/fields.hpp"
#include "report/wording.hpp"
#include "steps/flat_child.hpp"
#include "steps/flat_root.hpp"
#include "steps/json_edits.hpp"
#include "steps/references.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {
namespace {

using model::AssetInTree;

constexpr std::size_t kMostPlaces = 100'000;
constexpr std::uint64_t kMostCopied = std::uint64_t{1} << 30U;

/// An asset at a node that shows it; the first place is that of the asset itself.
struct FlatPlace {
  FlatChild* child = nullptr;
  std::size_t parent = SIZE_MAX;
  ListBases bases = {};
  bool first = false;                   ///< of its asset
  std::vector<std::size_t> shown = {};  ///< places, as FlatChild::shown()
};

std::string without_full_stop(std::string text) {
  if (text.ends_with('.')) text.pop_back();
  return text;
}

// Why an asset that was opened cannot be read, half a sentence.
std::optional<std::string> find_unreadable(const model::OpenedAsset& asset) {
  if (!asset.container().json) return "it is not glTF";
  const json::Document& document = asset.document();
  if (document.empty() || !document.is_object(document.root())) return "its JSON has errors";
  if (model::is_gltf_1(document)) return "glTF 1.0 is not supported";
  return std::nullopt;
}

class FlattenRun {
 public:
  explicit FlattenRun(const StepInput& input)
      : input_(input), document_(input.asset.document()), tree_(input.asset) {
    paths_.taken = change::referred_paths(document_);
  }

  Result<StepOutcome> run() {
    FlatChild& own = *children_.emplace(&tree_.root(), make(tree_.root())).first->second;
    if (own.shown().empty()) return std::move(outcome_);
    if (auto why = find_dangling_index(own.graph())) return Error{*std::move(why)};
    if (auto trouble = place_all(own)) return *trouble;
    FlatRoot root(own.graph());
    for (std::size_t i = 1; i < places_.size(); ++i) {
      if (auto trouble = copy(i, root)) return *trouble;
    }
    if (auto trouble = show(0, root.editor())) return *trouble;
    if (auto trouble = root.finish(own.tree(), outcome_.row)) return *trouble;
    outcome_.change.edits = root.editor().take();
    outcome_.freedom.new_objects = true;
    outcome_.row.what = fmt::format("{} at {}", report::counted(children_.size() - 1, "asset"),
                                    report::counted(places_.size() - 1, "node"));
    return std::move(outcome_);
  }

 private:
  std::unique_ptr<FlatChild> make(AssetInTree& tree) const {
    return std::make_unique<FlatChild>(tree, input_.schemas);
  }

  // Decides where all elements will be. Breadth first, so that an asset that shows many others does
  // not take stack.
  std::optional<Error> place_all(FlatChild& own) {
    for (const ChildList& list : own.lists()) counts_[list.key] = list.size;
    places_.push_back({&own, SIZE_MAX, ListBases(own.lists().size(), 0), false, {}});
    for (std::size_t i = 0; i < places_.size(); ++i) {
      for (const auto& [node, external] : places_[i].child->shown()) {
        auto child = open(i, external);
        if (!child) {
          return Error{fmt::format("{}/nodes/{}/externalAsset: {}",
                                   i == 0 ? "" : printable(places_[i].child->asset().name()) + " ",
                                   node, child.error().message)};
        }
        if (places_.size() > kMostPlaces || copied_text_ > kMostCopied) {
          return Error{fmt::format("it has more than {} external assets, or {} bytes of their JSON",
                                   kMostPlaces, kMostCopied)};
        }
        places_[i].shown.push_back(places_.size());
        places_.push_back({*child, i, {}, false, {}});
        set_bases(places_.back());
      }
    }
    return std::nullopt;
  }

  void set_bases(FlatPlace& place) {
    const std::vector<ChildList>& lists = place.child->lists();
    const auto [known, is_first] = shared_.try_emplace(place.child, ListBases(lists.size()));
    place.first = is_first;
    copied_text_ += place.child->asset().document().text().size();
    for (std::size_t i = 0; i < lists.size(); ++i) {
      if (is_first || lists[i].per_place) {
        std::uint64_t& count = counts_[lists[i].key];
        known->second[i] = count;
        count += lists[i].size;
      }
    }
    place.bases = known->second;
  }

  Result<FlatChild*> open(std::size_t place, std::uint32_t external) {
    AssetInTree& parent = places_[place].child->tree();
    const auto file = parent.file_of(external);
    if (!file) return Error{"there is no such external asset, or it has no file"};
    const auto& opened = tree_.asset(parent, *file);
    if (!opened) return Error{without_full_stop(opened.error().message)};
    AssetInTree& tree = **opened;
    const std::string name = printable(tree.asset().name());
    for (std::size_t at = place; at != SIZE_MAX; at = places_[at].parent) {
      if (places_[at].child->tree().identity() != tree.identity()) continue;
      return Error{fmt::format("{} shows itself", name)};
    }
    const auto known = children_.find(&tree);
    if (known != children_.end()) return known->second.get();
    if (auto why = find_unreadable(tree.asset())) return Error{fmt::format("{}: {}", name, *why)};
    FlatChild& child = *children_.emplace(&tree, make(tree)).first->second;
    if (auto why = child.find_obstacle()) return Error{fmt::format("{}: {}", name, *why)};
    if (auto trouble = child.move_files(paths_, outcome_.change)) {
      return Error{fmt::format("{}: {}", name, without_full_stop(trouble->message))};
    }
    child.list_losses(outcome_.row.losses);
    if (auto note = find_indices_in_extras(child.graph())) {
      note->reason = fmt::format("{} in {}", note->reason, name);
      outcome_.row.left.push_back(*std::move(note));
    }
    return &child;
  }

  // Puts the roots of shown assets below the nodes that show them.
  std::optional<Error> show(std::size_t place, json::Editor& editor) const {
    const FlatChild& child = *places_[place].child;
    const json::Document& document = child.asset().document();
    for (std::size_t i = 0; i < child.shown().size(); ++i) {
      const json::NodeId node = child.node(child.shown()[i].first);
      remove_member(document, editor, node, "externalAsset");
      if (auto trouble = append_children(document, editor, node, roots_of(places_[place].shown[i])))
        return trouble;
    }
    return std::nullopt;
  }

  std::vector<std::uint64_t> roots_of(std::size_t place) const {
    const FlatChild& child = *places_[place].child;
    std::uint64_t base = 0;
    for (std::size_t i = 0; i < child.lists().size(); ++i) {
      if (child.lists()[i].key == "/nodes") base = places_[place].bases[i];
    }
    std::vector<std::uint64_t> roots(child.roots().begin(), child.roots().end());
    for (std::uint64_t& root : roots) root += base;
    return roots;
  }

  static std::optional<Error> append_children(const json::Document& document, json::Editor& editor,
                                              json::NodeId node,
                                              const std::vector<std::uint64_t>& more) {
    if (more.empty()) return std::nullopt;
    const std::string text = fmt::format("{}", fmt::join(more, ","));
    const json::NodeId children = document.find(node, "children");
    if (children == json::kNoNode) {
      editor.append_member(node, "children", fmt::format("[{}]", text));
    } else if (document.kind(children) == json::Kind::number_array) {
      std::uint32_t end = 0;
      for (json::NumberCursor at(document, children); at.valid(); at.advance()) {
        end = at.number().span.end;
      }
      editor.replace_text({end, end}, ',' + text);
    } else if (document.is_array(children)) {
      for (const std::uint64_t index : more) editor.append_element(children, std::to_string(index));
    } else {
      return Error{"the children of a node are not a list"};
    }
    return std::nullopt;
  }

  // Adds the elements of one place to the root.
  std::optional<Error> copy(std::size_t at, FlatRoot& root) const {
    const FlatPlace& place = places_[at];
    const json::Document& document = place.child->asset().document();
    json::Editor editor(document);
    place.child->move_indices(place.bases, editor);
    if (auto trouble = show(at, editor)) return trouble;
    const json::Parsed moved = json::parse(json::apply_edits(document.text(), editor.take()));
    for (const ChildList& list : place.child->lists()) {
      if (place.first || list.per_place) root.add_list(moved.document, list.key);
    }
    return place.first ? root.add_asset(moved.document) : std::nullopt;
  }

  const StepInput& input_;
  const json::Document& document_;
  model::ExternalAssets tree_;
  std::map<const AssetInTree*, std::unique_ptr<FlatChild>> children_;
  std::map<const FlatChild*, ListBases> shared_;
  std::map<std::string, std::uint64_t> counts_;  ///< of elements so far, by list
  std::vector<FlatPlace> places_;
  std::uint64_t copied_text_ = 0;
  NewPaths paths_;
  StepOutcome outcome_;
};

}  // namespace

StepDescription flatten_step();
StepDescription flatten_step() {
  return {"flatten",
          "copies external assets into the asset, below the nodes that show them",
          "the picture, animations, names, and copyright of all assets",
          "which part is of which asset; extras and extensions of assets and scenes",
          [](const ConvertOptions& options) { return options.later.flatten; },
          [](const StepInput& input) { return FlattenRun(input).run(); }};
}

}  // namespace gltfx::steps

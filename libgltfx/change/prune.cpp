// SPDX-License-Identifier: Apache-2.0
#include "change/prune.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "base/text.hpp"
#include "change/bin_cut.hpp"
#include "change/name_list.hpp"
#include "change/removal.hpp"
#include "edit/extras.hpp"
#include "edit/pointers.hpp"
#include "json/writer.hpp"

namespace gltfx::change {
namespace {

using Indices = std::set<std::uint64_t>;

/// Positions below an index that are taken out, counted once for all.
class Shift {
 public:
  explicit Shift(const Indices& gone) : gone_(gone.begin(), gone.end()) {}
  std::uint64_t of(std::uint64_t index) const {
    const auto at = std::lower_bound(gone_.begin(), gone_.end(), index);
    return index - static_cast<std::uint64_t>(at - gone_.begin());
  }

 private:
  std::vector<std::uint64_t> gone_;
};

class Pruner {
 public:
  Pruner(const json::Document& document, const edit::References& references,
         const edit::Orphans& orphans)
      : document_(document), references_(references), orphans_(orphans), editor_(document) {}

  Result<Pruned> run(std::optional<std::uint64_t> bin_size) {
    if (const std::string obstacle = find_obstacle(); !obstacle.empty()) return Error{obstacle};
    if (bin_size) cut_bytes(*bin_size);
    for (const auto& [array, gone] : orphans_) {
      if (gone.empty()) continue;
      remove(array, gone);
      const Shift shift(gone);
      for (const edit::Reference& reference : references_.to(array)) move(reference, shift);
      move_pointers(array, shift);
    }
    remove_names();
    pruned_.edits = editor_.take();
    return std::move(pruned_);
  }

 private:
  std::string find_obstacle() {
    if (!references_.unknown_extension().empty()) {
      return fmt::format("{} is unknown and may contain indices",
                         gltfx::quoted(references_.unknown_extension()));
    }
    for (const json::NodeId value :
         edit::likely_indices(document_, {"texture", "image", "bufferview"})) {
      if (!document_.is_number(value)) continue;
      return fmt::format("{} may be an index", printable(document_.pointer_of(value)));
    }
    for (const edit::PointerUse& use : pointers_.all()) {
      const auto gone = orphans_.find(use.steps[0]);
      if (gone == orphans_.end() || gone->second.empty() || !edit::Pointers::is_template(use))
        continue;
      return "the target of a pointer is set at run time";
    }
    return {};
  }

  json::NodeId list(const std::string& array) const {
    return document_.find(document_.root(), array);
  }

  void remove(const std::string& array, const Indices& gone) {
    const json::NodeId nodes = list(array);
    std::vector<json::NodeId> elements;
    std::uint64_t index = 0;
    for (const json::NodeId element : document_.elements(nodes)) {
      if (gone.count(index++) != 0) elements.push_back(element);
    }
    removed_.insert(removed_.end(), elements.begin(), elements.end());
    if (gone.size() == document_.array_size(nodes)) {
      return editor_.remove(document_.root(), nodes - 1);
    }
    for (const json::NodeId element : elements) editor_.remove(nodes, element);
  }

  void remove_names() {
    const auto names = extensions_taken_out(document_, removed_);
    std::set<std::string> gone;
    for (const char* member : {"extensionsUsed", "extensionsRequired"}) {
      NameList list(document_, member);
      gone.merge(list.remove_all(names));
      list.apply(editor_);
    }
    pruned_.names.assign(gone.begin(), gone.end());
  }

  void move(const edit::Reference& reference, const Shift& shift) {
    const std::uint64_t now = shift.of(reference.index);
    if (now != reference.index) editor_.replace_text(reference.span, std::to_string(now));
  }

  void move_pointers(const std::string& array, const Shift& shift) {
    for (const edit::PointerUse& use : pointers_.all()) {
      if (use.steps[0] != array) continue;
      std::uint64_t index = 0;
      const std::string& step = use.steps[1];
      const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
      if (error != std::errc() || end != step.data() + step.size()) continue;
      std::string pointer;
      for (std::size_t i = 0; i < use.steps.size(); ++i) {
        append_pointer_step(pointer, i == 1 ? std::to_string(shift.of(index)) : use.steps[i]);
      }
      std::string json;
      json::append_string(json, pointer);
      editor_.replace_scalar(use.node, std::move(json));
    }
  }

  void cut_bytes(std::uint64_t bin_size) {
    const auto views = orphans_.find("bufferViews");
    if (views == orphans_.end()) return;
    const auto& to_buffers = references_.to("buffers");
    const auto to_bin = std::count_if(to_buffers.begin(), to_buffers.end(),
                                      [](const edit::Reference& each) { return each.index == 0; });
    pruned_.cut =
        cut_bin(document_, views->second, static_cast<std::uint64_t>(to_bin), bin_size, editor_);
  }

  const json::Document& document_;
  const edit::References& references_;
  const edit::Orphans& orphans_;
  const edit::Pointers pointers_{document_};
  json::Editor editor_;
  std::vector<json::NodeId> removed_;
  Pruned pruned_;
};

}  // namespace

Result<Pruned> prune(const json::Document& document, const edit::References& references,
                     const edit::Orphans& orphans, std::optional<std::uint64_t> bin_size) {
  return Pruner(document, references, orphans).run(bin_size);
}

}  // namespace gltfx::change

// SPDX-License-Identifier: Apache-2.0
#include "steps/view_pool.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "graph/renumber.hpp"
#include "graph/unknown_indices.hpp"
#include "report/wording.hpp"
#include "steps/json_edits.hpp"

namespace gltfx::steps {
namespace {

void collect_integers(const json::Document& document, json::NodeId object,
                      std::set<std::uint64_t>& integers) {
  const auto add = [&](const json::Number& number) {
    if (number.is_integer() && number.value >= 0) {
      integers.insert(static_cast<std::uint64_t>(number.value));
    }
  };
  for (json::NodeId id = object; id < document.next(object); ++id) {
    if (document.kind(id) == json::Kind::number) add(document.number(id));
    if (document.kind(id) != json::Kind::number_array) continue;
    for (json::NumberCursor at(document, id); at.valid(); at.advance()) add(at.number());
  }
}

}  // namespace

std::set<std::uint64_t> unknown_integers(const graph::Graph& graph) {
  std::set<std::uint64_t> integers;
  for (const json::NodeId object : graph.unknown_extensions()) {
    collect_integers(graph.tree().document(), object, integers);
  }
  return integers;
}

std::uint64_t ViewPool::add(container::Bytes bytes, std::uint64_t stride,
                            model::ViewTarget target) {
  length_ = bytes.size();
  begin_ = buffer_.add(std::move(bytes));
  if (taken_ < free_.size()) {
    const std::uint32_t view = free_[taken_++];
    declare(view, begin_, length_, stride, target);
    return view;
  }
  return additions_.add_element("bufferViews",
                                view_json({buffer_.index(), begin_, length_, stride, target}));
}

void ViewPool::declare(std::uint32_t index, std::uint64_t begin, std::uint64_t length,
                       std::uint64_t stride, model::ViewTarget target) {
  const json::Document& document = input_.asset.document();
  const json::NodeId view = input_.views.buffer_views[index].node;
  const auto set_or_remove = [&](std::string_view name, std::uint64_t value) {
    if (value > 0) {
      set_number(document, editor_, view, name, value);
    } else {
      remove_member(document, editor_, view, name);
    }
  };
  set_number(document, editor_, view, "buffer", buffer_.index());
  set_number(document, editor_, view, "byteOffset", begin);
  set_number(document, editor_, view, "byteLength", length);
  set_or_remove("byteStride", stride);
  set_or_remove("target", target == model::ViewTarget::none ? 0 : target_number(target));
}

void ViewPool::keep(const std::set<std::uint64_t>& meant, json::NodeId unknown,
                    StepOutcome& outcome) {
  for (std::size_t i = taken_; i < free_.size(); ++i) {
    const std::uint32_t view = free_[i];
    outcome.row.left.push_back(
        {fmt::format("/bufferViews/{}", view),
         fmt::format("it is unused, but {} may hold indices (describe it with --schema)",
                     printable(input_.pointer(unknown)))});
    outcome.freedom.unused = true;
    if (meant.contains(view) || length_ == 0) continue;
    declare(view, begin_, length_, 0, model::ViewTarget::none);
  }
}

void ViewPool::settle(const std::set<json::NodeId>& edited, StepOutcome& outcome) {
  if (taken_ == free_.size()) return;
  const json::NodeId unknown = graph::find_unknown_with_integer(input_.graph);
  if (unknown != json::kNoNode) return keep(unknown_integers(input_.graph), unknown, outcome);
  const json::Document& document = input_.asset.document();
  const json::NodeId list = document.find(document.root(), "bufferViews");
  removed_.assign(free_.begin() + static_cast<std::ptrdiff_t>(taken_), free_.end());
  std::sort(removed_.begin(), removed_.end());
  std::map<std::string_view, std::uint64_t> lost;
  for (const std::uint64_t view : removed_) {
    const json::NodeId node = input_.views.buffer_views[view].node;
    for (const std::string_view name : free_members(document, node)) ++lost[name];
    editor_.remove(list, node);
  }
  for (const auto& [name, count] : lost) {
    outcome.row.losses.push_back(
        {fmt::format("the {} of {}", printable(name), report::counted(count, "buffer view")),
         0,
         0,
         {}});
  }
  auto edits = graph::renumber(
      input_.graph,
      [&](json::NodeId array, std::uint64_t index) {
        return array == list ? position(index) : index;
      },
      [&](graph::Place place) { return !place.element && edited.contains(place.node); });
  for (json::Edit& edit : edits) editor_.replace_text(edit.span, std::move(edit.text));
}

std::uint64_t ViewPool::position(std::uint64_t view) const {
  const auto before = std::lower_bound(removed_.begin(), removed_.end(), view);
  return view - static_cast<std::uint64_t>(before - removed_.begin());
}

}  // namespace gltfx::steps

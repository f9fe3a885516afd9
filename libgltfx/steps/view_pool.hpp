// SPDX-License-Identifier: Apache-2.0
/// Buffer views of steps: those that lose their last user take new bytes.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "change/additions.hpp"
#include "container/bytes.hpp"
#include "json/edit.hpp"
#include "steps/geometry_input.hpp"
#include "steps/new_buffer.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// Integers in objects of extensions without a schema, any of which may be an index.
std::set<std::uint64_t> unknown_integers(const graph::Graph& graph);

/// First free() and add(), then settle(), then position(). All arguments must outlive it.
class ViewPool {
 public:
  ViewPool(const GeometryInput& input, NewBuffer& buffer, change::Additions& additions,
           json::Editor& editor)
      : input_(input), buffer_(buffer), additions_(additions), editor_(editor) {}

  /// A view whose last user goes. Precondition: it has no extensions, and is not freed yet.
  void free(std::uint32_t view) { free_.push_back(view); }

  /// Bytes in a view that is free or new; gives its number. `stride` 0: none.
  std::uint64_t add(container::Bytes bytes, std::uint64_t stride, model::ViewTarget target);

  /// Removes the views that are still free, and lets all indices follow but those at `edited`
  /// values, which the caller replaces. Where an extension without a schema may hold indices, views
  /// stay: they get the bytes of another one, unless they may be meant themselves; row.left names
  /// them, and nothing uses them.
  void settle(const std::set<json::NodeId>& edited, StepOutcome& outcome);

  /// The index of a view, by its number or by its old index.
  std::uint64_t position(std::uint64_t view) const;

 private:
  void declare(std::uint32_t view, std::uint64_t begin, std::uint64_t length, std::uint64_t stride,
               model::ViewTarget target);
  void keep(const std::set<std::uint64_t>& meant, json::NodeId unknown, StepOutcome& outcome);

  const GeometryInput& input_;
  NewBuffer& buffer_;
  change::Additions& additions_;
  json::Editor& editor_;
  std::vector<std::uint32_t> free_;
  std::size_t taken_ = 0;                 ///< of these, from the first on
  std::uint64_t begin_ = 0, length_ = 0;  ///< of the bytes that came last
  std::vector<std::uint64_t> removed_;    ///< in order
};

}  // namespace gltfx::steps

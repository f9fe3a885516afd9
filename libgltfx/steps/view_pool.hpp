// SPDX-License-Identifier: Apache-2.0
/// Reuses buffer views that lose their last user for new bytes.
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

/// All integers in objects of extensions without a schema: each of them may be an index.
std::set<std::uint64_t> unknown_integers(const graph::Graph& graph);

/// Call free() and add() first, then settle(), then position(). All arguments must outlive it.
class ViewPool {
 public:
  ViewPool(const GeometryInput& input, NewBuffer& buffer, change::Additions& additions,
           json::Editor& editor)
      : input_(input), buffer_(buffer), additions_(additions), editor_(editor) {}

  /// Frees a view that loses its last user. Precondition: it has no extensions and is not free.
  void free(std::uint32_t view) { free_.push_back(view); }

  /// Stores bytes in a free or new view and returns its number. `stride` 0: none.
  std::uint64_t add(container::Bytes bytes, std::uint64_t stride, model::ViewTarget target);

  /// Removes the views that are still free and updates all indices, except `edited` values, which
  /// the caller replaces. If an extension without a schema may hold indices, the views stay unused
  /// and are listed in row.left. They refer to the bytes of another view, unless their own index
  /// may occur in the extension.
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
  std::size_t taken_ = 0;                 ///< number of reused views, from the first
  std::uint64_t begin_ = 0, length_ = 0;  ///< of the last added bytes
  std::vector<std::uint64_t> removed_;    ///< sorted
};

}  // namespace gltfx::steps

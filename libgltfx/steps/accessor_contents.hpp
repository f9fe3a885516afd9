// SPDX-License-Identifier: Apache-2.0
/// Replaces elements of accessors; their number may change.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "change/additions.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/opened_asset.hpp"
#include "model/resource_data.hpp"
#include "steps/new_buffer.hpp"

namespace gltfx::steps {

/// New elements of one accessor.
struct NewElements {
  std::string bytes;  ///< `count` elements, each of model::packed_stride()
  std::uint64_t count = 0;
  /// Whether to recompute declared bounds. Bounds that do not change keep their text.
  bool other_values = false;
};

/// Stores new elements. Accessors keep their index, their buffer view and its interleaving. If the
/// view has users that are not accessors, or if the counts of interleaved accessors would differ,
/// the accessor gets its own view. All arguments must outlive this object; `resources` contains all
/// buffers of `asset`.
class AccessorContents {
 public:
  AccessorContents(const model::OpenedAsset& asset, const graph::Graph& graph,
                   const model::ResourceData& resources, NewBuffer& buffer,
                   change::Additions& additions, json::Editor& editor);

  /// Precondition: the accessor is not sparse and has a buffer view and a known format.
  void set(std::uint32_t accessor, NewElements elements);
  bool empty() const { return set_.empty(); }

  /// Adds the bytes to the buffer, and edits of accessors and views to the editor. Call it once.
  /// Returns an Error (half a sentence) if the bytes of another accessor in a view are missing.
  std::optional<Error> store();

 private:
  struct Block {
    std::uint64_t begin = 0;               ///< in the old view
    std::vector<std::uint32_t> accessors;  ///< interleaved, in the order of their offsets
  };

  std::uint64_t count_of(std::uint32_t accessor) const;
  std::optional<std::vector<Block>> blocks_of(std::uint32_t view) const;
  std::optional<Error> store_view(std::uint32_t view, const std::vector<Block>& blocks);
  void store_alone(std::uint32_t accessor, const NewElements& elements);
  void declare(std::uint32_t accessor, std::uint64_t offset);

  const json::Document& document_;
  const model::Views& views_;
  const graph::Graph& graph_;
  const model::ResourceData& resources_;
  NewBuffer& buffer_;
  change::Additions& additions_;
  json::Editor& editor_;
  std::map<std::uint32_t, NewElements> set_;                       ///< by accessor
  std::map<std::uint32_t, std::vector<std::uint32_t>> accessors_;  ///< by view
};

}  // namespace gltfx::steps

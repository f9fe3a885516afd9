// SPDX-License-Identifier: Apache-2.0
/// Takes orphans out of a document: what stands behind them moves up, and so does every index that
/// leads there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/result.hpp"
#include "change/change.hpp"
#include "edit/orphans.hpp"
#include "json/edit.hpp"

namespace gltfx::change {

struct Pruned {
  std::vector<json::Edit> edits;  ///< as json::Editor::take() gives them
  /// Bytes of the BIN chunk to take out, in order: nothing else lies in them. What stands behind
  /// moves by a multiple of 4.
  std::vector<ByteRange> cut;
  std::vector<std::string> names;  ///< of extensions that have lost their last object
};

/// An Error that says why nothing may move: somebody may hold indices that nobody knows as such.
/// Where buffer 0 is the BIN chunk of a GLB, `bin_size` are its bytes; they are cut where all that
/// lies in it is known.
Result<Pruned> prune(const json::Document& document, const edit::References& references,
                     const edit::Orphans& orphans, std::optional<std::uint64_t> bin_size);

}  // namespace gltfx::change

// SPDX-License-Identifier: Apache-2.0
#include "edit/rewrite.hpp"

#include <utility>

#include "container/pieces.hpp"

namespace gltfx::edit {

using container::Bytes;

Result<std::vector<Bytes>> rewrite(const container::Container& container,
                                   std::span<const json::Edit> edits, const BinChange& bin) {
  std::string json = json::apply_edits(*container.json, edits);
  if (container.format == container::Format::glb) return rewrite_glb(container, json, bin);
  return std::vector<Bytes>{Bytes::from_string(std::move(json))};
}

Result<container::Container> rewritten(const container::Container& container,
                                       std::span<const json::Edit> edits, const BinChange& bin,
                                       const std::string& path) {
  if (container.format == container::Format::glb && !bin.empty()) {
    const auto pieces = rewrite(container, edits, bin);
    if (!pieces) return pieces.error();
    return container::open_bytes(Bytes::from_string(container::join(*pieces)), path);
  }
  container::Container changed = container;
  changed.json = share_text(json::apply_edits(*container.json, edits));
  return changed;
}

}  // namespace gltfx::edit

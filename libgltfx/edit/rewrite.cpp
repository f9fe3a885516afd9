// SPDX-License-Identifier: Apache-2.0
#include "edit/rewrite.hpp"

#include "container/pieces.hpp"

namespace gltfx::edit {

using container::Bytes;

Result<std::vector<Bytes>> rewrite(const container::Container& container, const SharedText& json,
                                   const BinChange& bin) {
  if (container.format == container::Format::glb) return rewrite_glb(container, *json, bin);
  return std::vector<Bytes>{Bytes::from_text(json)};
}

Result<container::Container> rewritten(const container::Container& container,
                                       const SharedText& json, const BinChange& bin,
                                       const std::string& path) {
  if (container.format == container::Format::glb && !bin.empty()) {
    const auto pieces = rewrite(container, json, bin);
    if (!pieces) return pieces.error();
    return container::open_bytes(Bytes::from_string(container::join(*pieces)), path);
  }
  container::Container changed = container;
  changed.json = json;
  return changed;
}

}  // namespace gltfx::edit

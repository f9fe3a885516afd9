// SPDX-License-Identifier: Apache-2.0
#include "container/bytes.hpp"

#include <utility>

namespace gltfx::container {

Bytes Bytes::from_string(std::string text) { return from_text(share_text(std::move(text))); }

Bytes Bytes::from_text(const SharedText& text) {
  if (!text) return {};
  return {std::as_bytes(std::span(text->data(), text->size())), text};
}

}  // namespace gltfx::container

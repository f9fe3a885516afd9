// SPDX-License-Identifier: Apache-2.0
#include "container/bytes.hpp"

#include <utility>

namespace gltfx::container {

Bytes Bytes::from_string(std::string text) {
  auto owner = std::make_shared<const std::string>(std::move(text));
  return {std::as_bytes(std::span(owner->data(), owner->size())), owner};
}

}  // namespace gltfx::container

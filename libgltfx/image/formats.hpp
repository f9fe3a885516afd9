// SPDX-License-Identifier: Apache-2.0
/// The readers behind `read_header`, one file a format. Each gets bytes that begin with its magic.
#pragma once

#include <string>

#include "image/header.hpp"

namespace gltfx::image {

HeaderResult read_png(std::span<const std::byte> bytes);
HeaderResult read_jpeg(std::span<const std::byte> bytes);
HeaderResult read_webp(std::span<const std::byte> bytes);

inline HeaderFault unexpected_end() { return {HeaderFault::Kind::unexpected_end, {}}; }
inline HeaderFault invalid(std::string problem) {
  return {HeaderFault::Kind::invalid, std::move(problem)};
}

}  // namespace gltfx::image

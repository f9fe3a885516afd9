// SPDX-License-Identifier: Apache-2.0
/// The readers behind `read_header`, one file a format. Each gets bytes that begin with its magic.
#pragma once

#include <string>
#include <utility>

#include "image/header.hpp"

namespace gltfx::image {

HeaderResult read_png(std::span<const std::byte> bytes);
HeaderResult read_jpeg(std::span<const std::byte> bytes);
HeaderResult read_webp(std::span<const std::byte> bytes);

inline HeaderError unexpected_end() { return {HeaderError::Kind::unexpected_end, {}}; }
inline HeaderError invalid(std::string problem) {
  return {HeaderError::Kind::invalid, std::move(problem)};
}

/// Keeps the first problem that makes readers refuse an image.
inline void doubt(Header& header, std::string problem) {
  if (header.doubt.empty()) header.doubt = std::move(problem);
}
/// Keeps the first problem that readers pass over, or over which they differ.
inline void remark(Header& header, std::string problem, bool readers_differ) {
  if (!header.remark.empty() && header.readers_differ >= readers_differ) return;
  header.remark = std::move(problem);
  header.readers_differ = readers_differ;
}

}  // namespace gltfx::image

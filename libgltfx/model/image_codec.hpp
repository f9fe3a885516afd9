// SPDX-License-Identifier: Apache-2.0
/// Which images can be decoded, and as what.
#pragma once

#include <optional>

#include "codec/client.hpp"
#include "image/header.hpp"

namespace gltfx::model {

/// Nothing for formats whose pixels cannot be had.
inline std::optional<codec::ImageFormat> codec_format(image::Format format) {
  switch (format) {
    case image::Format::png:
      return codec::ImageFormat::png;
    case image::Format::jpeg:
      return codec::ImageFormat::jpeg;
    case image::Format::webp:
      return codec::ImageFormat::webp;
    case image::Format::ktx2:
      break;
  }
  return std::nullopt;
}

}  // namespace gltfx::model

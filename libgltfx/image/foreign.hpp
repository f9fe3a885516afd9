// SPDX-License-Identifier: Apache-2.0
/// Image formats that are not part of glTF but occur in assets. They are detected by their first
/// bytes; headers are read by a decoder.
///
/// Sources: BITMAPINFOHEADER (Microsoft), Truevision TGA 2.0, GIF89a, TIFF 6.0, Photoshop file
/// formats (Adobe, 2019), DDS (Microsoft), JPEG 2000 (ITU-T T.800), Netpbm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace gltfx::image {

/// `pnm`: PBM, PGM, PPM and PFM.
enum class ForeignFormat : std::uint8_t { bmp, tga, gif, tiff, psd, dds, jpeg2000, pnm };

/// "BMP" and so on, for messages.
std::string_view foreign_name(ForeignFormat format);

/// Nothing for image formats of glTF, for unknown bytes, and for too few bytes. TGA has no mark at
/// its beginning: it is detected if its header has only values of TGA, and there are enough bytes
/// for its texels.
std::optional<ForeignFormat> sniff_foreign(std::span<const std::byte> bytes);

}  // namespace gltfx::image

// SPDX-License-Identifier: Apache-2.0
/// Images that glTF does not have, though assets contain them. They are told by their first bytes;
/// what is in their headers, a decoder says.
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

/// "BMP" and so on, for people.
std::string_view foreign_name(ForeignFormat format);

/// Nothing for images of glTF, for unknown bytes, and for those that are too short to tell. TGA has
/// no mark at its beginning: it is taken for one where its header has no value that TGA lacks, and
/// there are as many texels as it says.
std::optional<ForeignFormat> sniff_foreign(std::span<const std::byte> bytes);

}  // namespace gltfx::image

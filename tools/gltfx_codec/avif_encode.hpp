// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Encodes texels of 8 or 16 bits as AVIF with 8 bits, decodes the file, and measures the
/// difference. Colours keep the full resolution (4:4:4) and have `job.quality`; alpha is lossless,
/// and left out if it is 1 everywhere.
Answer encode_avif(const Job& job, std::span<const std::byte> texels, const Output& output);

}  // namespace gltfx::codec

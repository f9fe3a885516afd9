// SPDX-License-Identifier: Apache-2.0
/// Code shared by the encoders of images. The same texels result in the same bytes: no times, no
/// names.
#pragma once

#include <cstddef>
#include <span>

#include "codec/server.hpp"

namespace gltfx::codec {

// Each encodes the texels that `job.raster` describes; formats and forms have been checked.

// With `job.options.smallest`, encoding takes longer and results in fewer bytes.

/// PNG with any depth and number of channels.
Answer encode_png(const Job& job, std::span<const std::byte> texels, const Output& output);
/// WebP, still or animated, lossless with quality 0; colours of transparent texels are kept, grey
/// becomes RGB.
Answer encode_webp(const Job& job, std::span<const std::byte> texels, const Output& output);
Answer encode_jpeg(const Job& job, std::span<const std::byte> texels, const Output& output);
/// KTX2 with UASTC and Zstandard, all mipmap levels; `job.resize` says how they are made, and its
/// kind which transfer function the file has.
Answer encode_ktx2(const Job& job, std::span<const std::byte> texels, const Output& output);
/// EXR with floats, losslessly compressed.
Answer encode_exr(const Job& job, std::span<const std::byte> texels, const Output& output);

}  // namespace gltfx::codec

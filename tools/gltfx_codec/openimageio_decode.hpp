// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Loads what decoding needs, before there is a sandbox: it starts no thread.
void prepare_openimageio();

/// Decodes the format that the job names, of an animation the first frame and of layers what they
/// show together. Alpha is not multiplied into colours; no rotation for display. Other channels
/// than colours and alpha are left out.
Answer decode_openimageio(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec

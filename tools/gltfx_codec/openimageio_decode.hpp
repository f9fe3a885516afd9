// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Loads all code for decoding before the sandbox is entered. After this, there are no other
/// threads.
void prepare_openimageio();

/// Decodes the format of the job: of an animation the first frame, of layers the composite. Alpha
/// is not premultiplied; rotation for display is not applied. Channels other than colours and alpha
/// are left out.
Answer decode_openimageio(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec

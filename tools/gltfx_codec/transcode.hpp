// SPDX-License-Identifier: Apache-2.0
/// What becomes of an image in the worker: decoded, made smaller, encoded, as a job asks for it.
#pragma once

#include <cstddef>
#include <span>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Answers jobs of the tasks image, encode and transcode. May throw std::exception.
Answer serve_image(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec

// SPDX-License-Identifier: Apache-2.0
/// The work on an image in the worker: decoding, resizing and encoding according to a job.
#pragma once

#include <cstddef>
#include <span>

#include "codec/decode.hpp"

namespace gltfx::codec {

/// Answers jobs with the tasks image, encode and transcode. May throw std::exception.
Answer serve_image(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec

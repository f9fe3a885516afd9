// SPDX-License-Identifier: Apache-2.0
/// Drawn pixels as bytes of a file.
#pragma once

#include <gltfx/bake.hpp>

#include <cstdint>
#include <string>

#include "base/result.hpp"
#include "codec/client.hpp"

namespace gltfx {

/// Encodes in a worker process. `quality`: of WebP and JPEG, 0: WebP loses nothing. Precondition:
/// there are pixels.
Result<std::string> encode_pixels(const BakedPixels& pixels, codec::EncodedFormat format,
                                  std::uint32_t quality);

}  // namespace gltfx

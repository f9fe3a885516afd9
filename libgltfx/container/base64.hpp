// SPDX-License-Identifier: Apache-2.0
/// Strict base64 (RFC 4648 section 4).
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace gltfx::container {

/// The bytes that `text` encodes. No whitespace, no letters of the URL alphabet, padding to a
/// multiple of four, spare bits zero: two texts never decode to the same bytes. The Error names the
/// position of the first bad character, counted from 1.
Result<std::string> decode_base64(std::string_view text);

/// The encoded bytes, padded.
std::string encode_base64(std::string_view bytes);

/// The data URI of bytes of a media type.
std::string data_uri(std::string_view media_type, std::string_view bytes);

}  // namespace gltfx::container

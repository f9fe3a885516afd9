// SPDX-License-Identifier: Apache-2.0
/// Base64 as RFC 4648 section 4 has it, strictly.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace gltfx::container {

/// The bytes that `text` stands for. No whitespace, no letters of the URL alphabet, padding to a
/// multiple of four, spare bits zero: two texts never decode to the same bytes. The Error names
/// the first bad character by its place, counted from 1.
Result<std::string> decode_base64(std::string_view text);

/// The text for bytes, padded.
std::string encode_base64(std::string_view bytes);

/// The URI that holds bytes of a media type.
std::string data_uri(std::string_view media_type, std::string_view bytes);

}  // namespace gltfx::container

// SPDX-License-Identifier: Apache-2.0
/// What must hold for any bytes given to the JSON parser, with simdjson and nlohmann as judges.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gltfx::fuzz {

/// Parses `text` with all three parsers and compares verdict and values; checks spans, order and
/// pointers of the document. Empty when they agree, else the difference.
std::string check_json(std::string_view text);

}  // namespace gltfx::fuzz

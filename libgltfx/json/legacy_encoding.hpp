// SPDX-License-Identifier: Apache-2.0
/// Text in the encodings that programs used before UTF-8.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "json/edit.hpp"

namespace gltfx::json {

/// What the bytes of a text that are not UTF-8 stand for.
struct LegacyText {
  std::string_view encoding;  ///< "Latin-1", "Windows-1252", "Shift-JIS"
  std::vector<Edit> parts;    ///< in order, what they become in UTF-8; for apply_edits()
};

/// How a text that is not UTF-8 is to be read, or nothing: it is none of the encodings above. It is
/// Shift-JIS where most of its characters are pairs of bytes as only that has them; else stretches
/// that are UTF-8 stay. Precondition: less than 4 GiB.
std::optional<LegacyText> read_legacy_text(std::string_view text);

}  // namespace gltfx::json

// SPDX-License-Identifier: Apache-2.0
/// Text in the encodings that programs used before UTF-8.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "json/edit.hpp"

namespace gltfx::json {

/// The meaning of the bytes of a text that are not UTF-8.
struct LegacyText {
  std::string_view encoding;  ///< "Latin-1", "Windows-1252", "Shift-JIS"
  std::vector<Edit> parts;    ///< in order, their text in UTF-8; for apply_edits()
};

/// The encoding of a text that is not UTF-8, or nothing when it is not one of those above. It is
/// Shift-JIS when most of its characters are pairs of bytes that only Shift-JIS has; otherwise,
/// parts in UTF-8 stay. Precondition: less than 4 GiB.
std::optional<LegacyText> read_legacy_text(std::string_view text);

}  // namespace gltfx::json

// SPDX-License-Identifier: Apache-2.0
/// Text in the encodings that programs used before UTF-8.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/span.hpp"

namespace gltfx {

/// What the bytes of a text that are not UTF-8 stand for.
struct LegacyText {
  struct Part {
    Span span;         ///< in the text
    std::string utf8;  ///< what it becomes
  };
  std::string_view encoding;  ///< "Latin-1", "Windows-1252", "Shift-JIS"
  std::vector<Part> parts;    ///< in order

  /// The text with all parts in UTF-8.
  std::string convert(std::string_view text) const;
};

/// How a text that is not UTF-8 is to be read, or nothing: it is none of the encodings above. It is
/// Shift-JIS where most of its characters are pairs of bytes as only that has them; else stretches
/// that are UTF-8 stay. Precondition: less than 4 GiB.
std::optional<LegacyText> read_legacy_text(std::string_view text);

}  // namespace gltfx

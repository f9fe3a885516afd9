// SPDX-License-Identifier: Apache-2.0
/// Finds strings of JSON in texts, so that an image of a Set refers to them and does not repeat
/// them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>

namespace gltfx::schema {

using Texts = std::span<const std::string_view>;

/// Where a string begins.
struct TextPlace {
  std::uint32_t text = 0;  ///< index in the Texts
  std::uint32_t begin = 0;
};

class TextIndex {
 public:
  /// The shortest string that is found: a place takes as much as a shorter one.
  static constexpr std::size_t kShortest = 12;

  /// Texts of JSON, which stay where they are while this lives.
  explicit TextIndex(Texts texts);
  /// Where a text has this string, written without escapes.
  std::optional<TextPlace> find(std::string_view string) const;

 private:
  void add_strings(std::uint32_t text, std::string_view json);

  std::unordered_map<std::string_view, TextPlace> places_;
};

}  // namespace gltfx::schema

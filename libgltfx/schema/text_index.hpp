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
  /// The shortest string that is looked up: a place takes as many bytes as a shorter one.
  static constexpr std::size_t kShortest = 12;

  /// Texts of JSON, which must outlive this.
  explicit TextIndex(Texts texts);
  /// The place of this string, written without escapes, in the texts.
  std::optional<TextPlace> find(std::string_view string) const;

 private:
  void add_strings(std::uint32_t text, std::string_view json);

  std::unordered_map<std::string_view, TextPlace> places_;
};

}  // namespace gltfx::schema

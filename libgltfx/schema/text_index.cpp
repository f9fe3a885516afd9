// SPDX-License-Identifier: Apache-2.0
#include "schema/text_index.hpp"

namespace gltfx::schema {

TextIndex::TextIndex(Texts texts) {
  for (std::uint32_t i = 0; i < texts.size(); ++i) add_strings(i, texts[i]);
}

void TextIndex::add_strings(std::uint32_t text, std::string_view json) {
  for (std::size_t quote = json.find('"'); quote != json.npos;) {
    const std::size_t begin = quote + 1;
    bool has_escapes = false;
    std::size_t end = json.find_first_of("\\\"", begin);
    while (end != json.npos && json[end] == '\\') {
      has_escapes = true;
      end = json.find_first_of("\\\"", end + 2);
    }
    if (end == json.npos) return;
    if (!has_escapes && end - begin >= kShortest) {
      places_.try_emplace(json.substr(begin, end - begin),
                          TextPlace{text, static_cast<std::uint32_t>(begin)});
    }
    quote = json.find('"', end + 1);
  }
}

std::optional<TextPlace> TextIndex::find(std::string_view string) const {
  const auto found = places_.find(string);
  return found == places_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace gltfx::schema

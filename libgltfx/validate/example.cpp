// SPDX-License-Identifier: Apache-2.0
#include <gltfx/validate.hpp>

#include <charconv>
#include <string>
#include <string_view>

#include "container/base64.hpp"

namespace gltfx {
namespace {

// Appends what stands for `text*N`.
void append_repeat(std::string& out, std::string_view repeat) {
  const std::size_t star = repeat.rfind('*');
  if (star == std::string_view::npos) return;
  std::size_t count = 0;
  std::from_chars(repeat.data() + star + 1, repeat.data() + repeat.size(), count);
  for (std::size_t i = 0; i < count; ++i) out += repeat.substr(0, star);
}

std::string expand_repeats(std::string_view example) {
  std::string text;
  while (true) {
    const std::size_t open = example.find("{{");
    const std::size_t close = example.find("}}", open);
    if (open == std::string_view::npos || close == std::string_view::npos ||
        example.substr(open, close - open).find('*') == std::string_view::npos) {
      return text += example;
    }
    text += example.substr(0, open);
    append_repeat(text, example.substr(open + 2, close - open - 2));
    example.remove_prefix(close + 2);
  }
}

}  // namespace

std::string example_bytes(std::string_view example) {
  constexpr std::string_view kBase64 = "base64:";
  std::string text = expand_repeats(example);
  if (example.substr(0, kBase64.size()) != kBase64) return text;
  auto bytes = container::decode_base64(std::string_view(text).substr(kBase64.size()));
  return bytes ? *std::move(bytes) : std::string();
}

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
#include "json/utf8.hpp"

#include <simdjson.h>

#include "base/utf8.hpp"

namespace gltfx::json {
namespace {

// simdjson looks for the best implementation when it is first asked, in functions that end the
// program when memory is missing. So it is asked before anybody's work begins.
[[maybe_unused]] const bool kReady = simdjson::validate_utf8("", 0);

}  // namespace

bool is_utf8(std::string_view text) { return simdjson::validate_utf8(text.data(), text.size()); }

Span first_invalid_utf8(std::string_view text) {
  std::size_t at = 0;
  for (CodePoint point; at < text.size(); at += point.size) {
    point = decode_utf8(text, at);
    if (!point.valid) break;
  }
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t announced = lead < 0xC0 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  std::size_t end = at + 1;
  while (end < text.size() && end - at < announced && (text[end] & 0xC0) == 0x80) ++end;
  return {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end)};
}

}  // namespace gltfx::json

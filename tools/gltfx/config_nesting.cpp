// SPDX-License-Identifier: Apache-2.0
#include "config_nesting.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace gltfx::tool {
namespace {

constexpr int kDeepest = 16;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kEnd = std::string_view::npos;

// Behind the string that begins at `at`; kEnd where it does not end as it must.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool long_one = text.substr(at, 3) == three;
  for (at += long_one ? 3 : 1; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\') {
      ++at;
    } else if (long_one && text.substr(at, 3) == three) {
      // One or two more are the end of what it says.
      at += 3;
      for (int more = 0; more < 2 && at < text.size() && text[at] == quote; ++more) ++at;
      return at;
    } else if (!long_one && text[at] == quote) {
      return at + 1;
    } else if (!long_one && text[at] == '\n') {
      return kEnd;
    }
  }
  return kEnd;
}

std::uint32_t line_at(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::uint32_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace

ConfigObstacle find_obstacle(std::string_view text) {
  int depth = 0, dots = 0;
  for (std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
       at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = behind_string(text, at);
      if (at == kEnd) return {};
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (static_cast<unsigned char>(c) > 0x7F) {
      return {line_at(text, at), "only strings and comments may have characters beyond ASCII"};
    }
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (c == '.') {
      ++dots;
    } else if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') {
      dots = 0;
    }
    if (depth > kDeepest || dots > kDeepest) {
      return {line_at(text, at), "this is nested more deeply than any configuration"};
    }
    ++at;
  }
  return {};
}

}  // namespace gltfx::tool

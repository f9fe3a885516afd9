// SPDX-License-Identifier: Apache-2.0
#include "report/excerpt.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "report/display_width.hpp"
#include "report/safe_text.hpp"

namespace gltfx::report {
namespace {

// Excerpts count code points as LineIndex does, by the bytes that can begin one, so that the
// numbers keep their meaning when the text is not UTF-8.
std::size_t byte_of(std::string_view text, std::size_t code_point) {
  std::size_t at = 0;
  for (; at < text.size() && code_point > 0; --code_point) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) ++at;
  }
  return at;
}

void trim_right(std::string& text) { text.erase(text.find_last_not_of(' ') + 1); }

// A line in three parts, as it is printed.
struct Parts {
  std::string before, marked, after;
};

Parts split(const Excerpt& excerpt) {
  const std::string_view text = excerpt.text;
  const std::size_t begin = byte_of(text, excerpt.caret);
  const std::size_t end = begin + byte_of(text.substr(begin), excerpt.width);
  Parts parts{safe_part(text, 0, begin), safe_part(text, begin, end),
              safe_part(text, end, text.size())};
  if (excerpt.cut_left) parts.before = fmt::format("…{}", parts.before);
  if (excerpt.cut_right) {
    parts.after += "…";
  } else {
    trim_right(parts.after);
  }
  return parts;
}

}  // namespace

std::size_t gutter_width(const Diagnostic& diagnostic) {
  return fmt::formatted_size("{}", diagnostic.location.line);
}

std::string excerpt_lines(const Diagnostic& diagnostic, const Style& style) {
  const Parts parts = split(diagnostic.excerpt);
  const std::size_t carets = std::max<std::size_t>(display_width(parts.marked), 1);
  const std::string bar =
      style.paint(Ink::frame, fmt::format("{:{}} |", "", gutter_width(diagnostic)));
  const std::string number = style.paint(Ink::frame, fmt::format("{} |", diagnostic.location.line));
  std::string source = fmt::format(" {}{}{}", parts.before, parts.marked, parts.after);
  trim_right(source);
  return fmt::format("{0}\n{1}{2}\n{0} {3:{4}}{5}\n", bar, number, source, "",
                     display_width(parts.before),
                     style.paint(ink_of(diagnostic.severity), std::string(carets, '^')));
}

}  // namespace gltfx::report

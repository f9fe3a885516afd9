// SPDX-License-Identifier: Apache-2.0
#include "validate/changed_lines.hpp"

#include <algorithm>

namespace gltfx::validate {
namespace {

std::vector<LineRange> merged(std::vector<LineRange> lines) {
  std::sort(lines.begin(), lines.end(),
            [](const LineRange& a, const LineRange& b) { return a.first < b.first; });
  std::vector<LineRange> apart;
  for (const LineRange& range : lines) {
    if (!apart.empty() && range.first <= apart.back().last) {
      apart.back().last = std::max(apart.back().last, range.last);
    } else {
      apart.push_back(range);
    }
  }
  return apart;
}

// One past the end of the line that begins at `at`.
std::size_t line_end(std::string_view text, std::size_t at) {
  const std::size_t end = text.find_first_of("\r\n", at);
  if (end == std::string_view::npos) return text.size();
  return end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
}

}  // namespace

ChangedLines::ChangedLines(const std::vector<LineRange>& lines, std::string_view text)
    : any_(!lines.empty()) {
  size_ = static_cast<std::uint32_t>(text.size());
  std::size_t at = 0;
  std::uint64_t line = 1;
  for (const LineRange& range : merged(lines)) {
    for (; line < range.first && at < text.size(); ++line) at = line_end(text, at);
    const std::size_t begin = at;
    for (; line <= range.last && at < text.size(); ++line) at = line_end(text, at);
    if (begin < at) {
      last_line_ = at == text.size();
      spans_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at)});
    }
  }
}

bool ChangedLines::touches(Span span) const {
  if (span.end == 0) return any_;
  const auto next =
      std::upper_bound(spans_.begin(), spans_.end(), span.begin,
                       [](std::uint32_t byte, const Span& one) { return byte < one.end; });
  if (next != spans_.end()) return next->begin < std::max(span.end, span.begin + 1);
  return last_line_ && span.begin >= size_;  // what is missing at the end of the text
}

}  // namespace gltfx::validate

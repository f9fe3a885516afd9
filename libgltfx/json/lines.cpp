// SPDX-License-Identifier: Apache-2.0
#include "json/lines.hpp"

#include <algorithm>

namespace gltfx::json {
namespace {

constexpr std::size_t kBlock = 4096;

// How often `holds` is true from `begin` to `end`. The count of a stride fits a byte, so that the
// compiler adds as many at once as a vector has bytes.
template <class Holds>
std::uint32_t count_if(std::size_t begin, std::size_t end, const Holds& holds) {
  constexpr std::size_t kStride = 128;
  std::uint32_t count = 0;
  for (; begin + kStride <= end; begin += kStride) {
    std::uint8_t some = 0;
    for (std::size_t i = begin; i < begin + kStride; ++i) {
      some = static_cast<std::uint8_t>(some + (holds(i) ? 1 : 0));
    }
    count += some;
  }
  for (; begin < end; ++begin) count += holds(begin) ? 1 : 0;
  return count;
}

// A tail byte of UTF-8 starts no code point.
bool starts_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

std::uint32_t count_starts(std::string_view text) {
  const char* const bytes = text.data();
  return count_if(0, text.size(), [bytes](std::size_t i) { return starts_code_point(bytes[i]); });
}

// The lead byte of a code point beyond U+FFFF.
bool starts_pair(char c) { return static_cast<unsigned char>(c) >= 0xF0; }

std::uint32_t count_pairs(std::string_view text) {
  const char* const bytes = text.data();
  return count_if(0, text.size(), [bytes](std::size_t i) { return starts_pair(bytes[i]); });
}

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

}  // namespace

LineIndex::LineIndex(std::string_view text, std::size_t reach) : text_(text) {
  reach = std::min(reach, text.size());
  blocks_.reserve(reach / kBlock + 1);
  blocks_.emplace_back();
  for (std::size_t begin = 0; begin + kBlock <= reach; begin += kBlock) {
    const std::size_t end = begin + kBlock;
    Block next = blocks_.back();
    next.code_points += count_starts(text.substr(begin, kBlock));
    next.pairs += count_pairs(text.substr(begin, kBlock));
    const std::uint32_t lines = count_line_ends(begin, end);
    next.lines += lines;
    if (lines > 0) next.line_start = last_line_start(end);
    blocks_.push_back(next);
  }
}

// Whether the line ends with this byte; in "\r\n" it is the second one.
bool LineIndex::ends_line(std::size_t byte) const {
  if (text_[byte] == '\n') return true;
  return text_[byte] == '\r' && (byte + 1 == text_.size() || text_[byte + 1] != '\n');
}

std::uint32_t LineIndex::count_line_ends(std::size_t begin, std::size_t end) const {
  const char* const text = text_.data();
  const std::size_t inner = std::min(end, text_.size() - 1);
  const std::uint32_t count = count_if(begin, inner, [text](std::size_t i) {
    return ((text[i] == '\n') | ((text[i] == '\r') & (text[i + 1] != '\n'))) != 0;
  });
  return inner < end ? count + (ends_line(inner) ? 1 : 0) : count;
}

// The byte after the last line end before `byte`. Precondition: there is one.
std::uint32_t LineIndex::last_line_start(std::size_t byte) const {
  while (!ends_line(byte - 1)) --byte;
  return static_cast<std::uint32_t>(byte);
}

LineIndex::Place LineIndex::place_of(std::size_t byte) const {
  const std::size_t block = byte / kBlock;
  Place place{blocks_[block].lines, blocks_[block].line_start};
  const std::uint32_t lines = byte == block * kBlock ? 0 : count_line_ends(block * kBlock, byte);
  if (lines > 0) place = {place.line + lines, last_line_start(byte)};
  return place;
}

std::uint32_t LineIndex::code_points_before(std::size_t byte) const {
  const std::size_t block = byte / kBlock;
  return blocks_[block].code_points + count_starts(text_.substr(block * kBlock, byte % kBlock));
}

std::uint32_t LineIndex::column_of(std::size_t byte, std::size_t line_start) const {
  return code_points_before(byte) - code_points_before(line_start) + 1;
}

std::uint32_t LineIndex::pairs_before(std::size_t byte) const {
  const std::size_t block = byte / kBlock;
  return blocks_[block].pairs + count_pairs(text_.substr(block * kBlock, byte % kBlock));
}

std::uint32_t LineIndex::pairs_between(std::size_t line_start, std::size_t byte) const {
  return pairs_before(byte) - pairs_before(line_start);
}

Location LineIndex::locate(Span span, std::uint64_t base) const {
  const Place begin = place_of(span.begin);
  const Place end = place_of(span.end);
  Location location;
  location.line = begin.line + 1;
  location.column = column_of(span.begin, begin.line_start);
  location.end_line = end.line + 1;
  location.end_column = column_of(span.end, end.line_start);
  location.utf16_column = location.column + pairs_between(begin.line_start, span.begin);
  location.utf16_end_column = location.end_column + pairs_between(end.line_start, span.end);
  location.offset = base + span.begin;
  location.length = span.size();
  return location;
}

// At most `code_points` back from `byte`, not before `first`.
std::size_t LineIndex::back(std::size_t byte, std::size_t code_points, std::size_t first) const {
  while (byte > first && code_points > 0) {
    --byte;
    while (byte > first && !starts_code_point(text_[byte])) --byte;
    --code_points;
  }
  return byte;
}

// At most `code_points` on from `byte`, not beyond the end of the line.
std::size_t LineIndex::forward(std::size_t byte, std::size_t code_points) const {
  while (byte < text_.size() && code_points > 0 && !is_line_end(text_[byte])) {
    ++byte;
    while (byte < text_.size() && !starts_code_point(text_[byte])) ++byte;
    --code_points;
  }
  return byte;
}

bool LineIndex::is_end_of_line(std::size_t byte) const {
  return byte == text_.size() || is_line_end(text_[byte]);
}

Excerpt LineIndex::excerpt(Span span, std::size_t width) const {
  const std::size_t line_start = place_of(span.begin).line_start;
  const std::size_t marked_end = std::min<std::size_t>(forward(span.begin, width), span.end);
  const std::size_t marked = std::max<std::size_t>(count_starts(slice(span.begin, marked_end)), 1);
  const std::size_t context = marked < width ? width - marked : 0;
  // The part of the window that one side does not use goes to the other.
  const std::size_t right = count_starts(slice(marked_end, forward(marked_end, context)));
  const std::size_t left_share = std::max(context / 2, context - right);
  const std::size_t begin = back(span.begin, left_share, line_start);
  const std::size_t left = count_starts(slice(begin, span.begin));
  const std::size_t end = forward(marked_end, context - left);
  Excerpt excerpt;
  excerpt.text = std::string(slice(begin, end));
  excerpt.caret = static_cast<std::uint32_t>(left);
  excerpt.width = static_cast<std::uint32_t>(marked);
  excerpt.cut_left = begin > line_start;
  excerpt.cut_right = !is_end_of_line(end);
  return excerpt;
}

}  // namespace gltfx::json

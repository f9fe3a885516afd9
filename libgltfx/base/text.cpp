// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace gltfx {
namespace {

struct CodePoints {
  std::uint32_t first, last;
};

// Code points that move the cursor, end a line, reorder the text around them, or are invisible:
// those that Unicode calls controls, separators of lines, format characters (Cf) or default
// ignorable, letters that are drawn blank, private use and noncharacters (the last two of each
// plane: see is_unprintable()). Sorted.
constexpr std::array<CodePoints, 32> kUnprintable{{
    {0x0, 0x1F},        {0x7F, 0x9F},       {0xAD, 0xAD},       {0x34F, 0x34F},
    {0x600, 0x605},     {0x61C, 0x61C},     {0x6DD, 0x6DD},     {0x70F, 0x70F},
    {0x890, 0x891},     {0x8E2, 0x8E2},     {0x115F, 0x1160},   {0x17B4, 0x17B5},
    {0x180B, 0x180F},   {0x200B, 0x200F},   {0x2028, 0x202E},   {0x2060, 0x206F},
    {0x2800, 0x2800},   {0x3164, 0x3164},   {0xD800, 0xF8FF},   {0xFDD0, 0xFDEF},
    {0xFE00, 0xFE0F},   {0xFEFF, 0xFEFF},   {0xFFA0, 0xFFA0},   {0xFFF0, 0xFFFB},
    {0x110BD, 0x110BD}, {0x110CD, 0x110CD}, {0x13430, 0x1345F}, {0x1BCA0, 0x1BCA3},
    {0x1D159, 0x1D159}, {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF}, {0xF0000, 0x10FFFF},
}};

bool is_unprintable(std::uint32_t c) {
  if (c >= 0x20 && c < 0x7F) return false;
  if ((c & 0xFFFEU) == 0xFFFEU) return true;
  const auto* const behind = std::upper_bound(
      kUnprintable.begin(), kUnprintable.end(), c,
      [](std::uint32_t point, const CodePoints& range) { return point < range.first; });
  return behind != kUnprintable.begin() && c <= std::prev(behind)->last;
}

void append_printable(std::string& out, std::string_view text, std::size_t at, CodePoint point) {
  if (!point.valid) {
    fmt::format_to(std::back_inserter(out), "\\x{:02x}", point.value);
  } else if (point.value == '\t') {
    out += ' ';
  } else if (!is_unprintable(point.value)) {
    out += text.substr(at, point.size);
  } else if (point.value < 0x10000) {
    fmt::format_to(std::back_inserter(out), "\\u{:04x}", point.value);
  } else {
    fmt::format_to(std::back_inserter(out), "\\u{{{:x}}}", point.value);
  }
}

// Length that a lead byte announces, 0 when it leads nothing.
std::uint32_t announced_size(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

bool is_scalar(std::uint32_t value, std::uint32_t size) {
  if (size == 3) return value >= 0x800 && (value < 0xD800 || value > 0xDFFF);
  if (size == 4) return value >= 0x10000 && value <= 0x10FFFF;
  return true;
}

// Distances are counted in half edits, because a wrong case is half of one.
constexpr std::size_t kEdit = 2;
// Longer words are not misspelt names; the limit keeps the quadratic distance small.
constexpr std::size_t kLongestWord = 128;

std::size_t substitution(char a, char b) {
  if (a == b) return 0;
  return ascii_lower(a) == ascii_lower(b) ? kEdit / 2 : kEdit;
}

// Damerau-Levenshtein distance (optimal string alignment) over three rolling rows.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> above(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j * kEdit;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, above);
    std::swap(above, row);
    row[0] = i * kEdit;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min(
          {above[j] + kEdit, row[j - 1] + kEdit, above[j - 1] + substitution(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && a[i - 1] != b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + kEdit);
      }
    }
  }
  return row[b.size()];
}

// The letters, without case and '_': "base_color_factor" is "baseColorFactor".
std::string letters_of(std::string_view word) {
  std::string letters = lower_case(word);
  letters.erase(std::remove(letters.begin(), letters.end(), '_'), letters.end());
  return letters;
}

// Farther words are a guess.
constexpr std::size_t kMostEdits = 2;

// Whether one word is the beginning of the other, as "MASK" of "MASKED".
bool begins(std::string_view a, std::string_view b) {
  const std::size_t length = std::min(a.size(), b.size());
  return length >= 3 && lower_case(a.substr(0, length)) == lower_case(b.substr(0, length));
}

// A third of the letters may be wrong, but no more than two; an ending may have two in any word.
std::size_t tolerance(std::string_view a, std::string_view b) {
  const std::size_t edits = begins(a, b) ? kMostEdits : std::min(a.size(), b.size()) / 3;
  return std::min(edits, kMostEdits) * kEdit;
}

// The candidate that differs from the word in spelling only, if it is the only one; or empty.
std::string_view only_other_spelling(std::string_view word,
                                     std::span<const std::string_view> candidates) {
  const std::string letters = letters_of(word);
  std::string_view found;
  for (const std::string_view candidate : candidates) {
    if (letters.empty() || candidate == found || letters_of(candidate) != letters) continue;
    if (!found.empty()) return {};
    found = candidate;
  }
  return found;
}

}  // namespace

std::string printable(std::string_view text) {
  const auto is_plain = [](char c) { return c >= ' ' && c <= '~'; };
  if (std::all_of(text.begin(), text.end(), is_plain)) return std::string(text);
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode_utf8(text, at);
    append_printable(out, text, at, point);
    at += point.size;
  }
  return out;
}

std::string quoted(std::string_view text, std::size_t limit) {
  const std::size_t shown = bytes_of_code_points(text, limit);
  return fmt::format("'{}{}'", printable(text.substr(0, shown)), shown < text.size() ? "…" : "");
}

std::size_t count_code_points(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); at += decode_utf8(text, at).size) ++count;
  return count;
}

std::size_t bytes_of_code_points(std::string_view text, std::size_t code_points) {
  if (text.size() <= code_points) return text.size();
  std::size_t at = 0;
  for (; code_points > 0 && at < text.size(); --code_points) at += decode_utf8(text, at).size;
  return at;
}

std::string join_or(std::span<const std::string> items, std::size_t limit) {
  std::string text;
  const std::size_t shown = items.size() < limit ? items.size() : limit;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == items.size() ? " or " : ", ";
    text += items[i];
  }
  if (const std::size_t rest = items.size() - shown; rest > 0) {
    fmt::format_to(std::back_inserter(text), "{}{} other{}", shown > 0 ? " or " : "", rest,
                   rest == 1 ? "" : "s");
  }
  return text;
}

std::string join_and(std::span<const std::string> items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = ascii_lower(c);
  return lower;
}

std::string_view without_stop(std::string_view sentence) {
  return sentence.ends_with('.') ? sentence.substr(0, sentence.size() - 1) : sentence;
}

std::string half_sentence(std::string_view sentence) { return printable(without_stop(sentence)); }

std::string capitalized(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  return text;
}

std::string ending_of(std::string_view path) {
  return lower_case(std::filesystem::path(path).extension().native());
}

bool has_glb_ending(std::string_view path) {
  const std::string ending = ending_of(path);
  return ending == ".glb" || ending == ".vrm";
}

CodePoint decode_utf8(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const CodePoint invalid{lead, 1, false};
  const std::uint32_t size = announced_size(lead);
  if (size == 0 || size > text.size() - at) return invalid;
  std::uint32_t value = size == 1 ? lead : lead & (0x7Fu >> size);
  for (std::uint32_t i = 1; i < size; ++i) {
    const auto next = static_cast<unsigned char>(text[at + i]);
    if ((next & 0xC0) != 0x80) return invalid;
    value = value << 6 | (next & 0x3Fu);
  }
  if (!is_scalar(value, size)) return invalid;
  return {value, size, true};
}

void append_utf8(std::string& out, std::uint32_t code_point) {
  const auto tail = [&](unsigned shift) {
    out += static_cast<char>(0x80u | (code_point >> shift & 0x3Fu));
  };
  if (code_point < 0x80) {
    out += static_cast<char>(code_point);
  } else if (code_point < 0x800) {
    out += static_cast<char>(0xC0u | code_point >> 6);
    tail(0);
  } else if (code_point < 0x10000) {
    out += static_cast<char>(0xE0u | code_point >> 12);
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xF0u | code_point >> 18);
    tail(12);
    tail(6);
    tail(0);
  }
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  if (word.empty() || word.size() > kLongestWord) return best;
  std::size_t best_distance = SIZE_MAX;
  for (const std::string_view candidate : candidates) {
    const std::size_t allowed = tolerance(word, candidate);
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t shorter = std::min(word.size(), candidate.size());
    if (candidate.empty() || (longer - shorter) * kEdit > allowed) continue;
    const std::size_t found = distance(word, candidate);
    if (found <= allowed && found < best_distance) {
      best = candidate;
      best_distance = found;
    }
  }
  return best.empty() ? only_other_spelling(word, candidates) : best;
}

}  // namespace gltfx

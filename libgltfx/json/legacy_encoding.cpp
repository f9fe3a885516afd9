// SPDX-License-Identifier: Apache-2.0
#include "json/legacy_encoding.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <iconv.h>

#include "base/text.hpp"

namespace gltfx::json {
namespace {

constexpr unsigned char byte_of(char c) { return static_cast<unsigned char>(c); }
constexpr bool is_high(char c) { return byte_of(c) >= 0x80; }

// Bytes 0x80 to 0x9F of Windows-1252 (WHATWG Encoding Standard); 0: no character.
constexpr std::array<std::uint16_t, 32> kWindows1252{
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017D, 0,      0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

Span span_of(std::size_t begin, std::size_t end) {
  return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

std::optional<LegacyText> read_western(std::string_view text) {
  LegacyText found{"Latin-1", {}};
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode_utf8(text, at);
    at += point.size;
    if (point.valid) continue;
    std::uint32_t value = point.value;
    if (value < 0xA0) {
      value = kWindows1252[value - 0x80];
      found.encoding = "Windows-1252";
    }
    if (value == 0) return std::nullopt;
    const bool joined = !found.parts.empty() && found.parts.back().span.end == at - 1;
    if (!joined) found.parts.push_back({span_of(at - 1, at), {}});
    found.parts.back().span.end = static_cast<std::uint32_t>(at);
    append_utf8(found.parts.back().text, value);
  }
  return found;
}

constexpr bool is_lead(char c) {
  return (byte_of(c) >= 0x81 && byte_of(c) <= 0x9F) || (byte_of(c) >= 0xE0 && byte_of(c) <= 0xFC);
}

/// Converts parts of a text in Shift-JIS, in the form of Windows (code page 932).
class ShiftJis {
 public:
  ShiftJis() : state_(::iconv_open("UTF-8", "CP932")) {}
  ShiftJis(const ShiftJis&) = delete;
  ShiftJis& operator=(const ShiftJis&) = delete;
  ~ShiftJis() {
    if (is_known()) ::iconv_close(state_);
  }

  /// The C library may lack the encoding.
  bool is_known() const { return state_ != iconv_t(-1); }  // NOLINT: the value that POSIX specifies

  std::optional<std::string> convert(std::string_view bytes) {
    std::string in(bytes);
    std::string out(bytes.size() * 3, '\0');
    char* from = in.data();
    char* to = out.data();
    std::size_t left = in.size();
    std::size_t room = out.size();
    if (::iconv(state_, &from, &left, &to, &room) != 0 || left != 0) return std::nullopt;
    out.resize(out.size() - room);
    return out;
  }

 private:
  iconv_t state_;
};

// The first byte of kana and frequent kanji is a control character or a quotation mark in other
// encodings. A single one before a letter is more likely an apostrophe.
bool looks_japanese(std::string_view stretch) {
  std::size_t pairs = 0;
  std::size_t frequent = 0;
  for (std::size_t at = 0; at < stretch.size(); ++at) {
    if (!is_lead(stretch[at])) continue;
    ++pairs;
    if (byte_of(stretch[at]) < 0xA0) ++frequent;
    ++at;
  }
  return frequent > 0 && (pairs > 1 || is_high(stretch.back()));
}

std::optional<LegacyText> read_japanese(std::string_view text) {
  ShiftJis converter;
  if (!converter.is_known()) return std::nullopt;
  LegacyText found{"Shift-JIS", {}};
  std::size_t japanese = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    while (at < text.size() && is_high(text[at])) at += is_lead(text[at]) ? 2 : 1;
    if (at > text.size()) return std::nullopt;
    if (at == begin) {
      ++at;
      continue;
    }
    auto utf8 = converter.convert(text.substr(begin, at - begin));
    if (!utf8) return std::nullopt;
    if (looks_japanese(text.substr(begin, at - begin))) ++japanese;
    found.parts.push_back({span_of(begin, at), *std::move(utf8)});
  }
  if (japanese * 2 <= found.parts.size()) return std::nullopt;
  return found;
}

}  // namespace

std::optional<LegacyText> read_legacy_text(std::string_view text) {
  auto found = read_japanese(text);
  return found ? std::move(found) : read_western(text);
}

}  // namespace gltfx::json

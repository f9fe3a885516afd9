// SPDX-License-Identifier: Apache-2.0
#include "container/base64.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::container {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint32_t kBad = 0xFF000000;  // survives the or of four values of 6 bits

constexpr std::array<std::uint32_t, 256> make_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t& value : table) value = kBad;
  for (std::uint32_t i = 0; i < kAlphabet.size(); ++i) {
    table[static_cast<unsigned char>(kAlphabet[i])] = i;
  }
  return table;
}

constexpr std::array<std::uint32_t, 256> kValues = make_table();

std::uint32_t value_of(char c) { return kValues[static_cast<unsigned char>(c)]; }

/// 24 bits, or something with bits of kBad.
std::uint32_t quartet(const char* c) {
  const std::uint32_t a = value_of(c[0]);
  const std::uint32_t b = value_of(c[1]);
  const std::uint32_t d = value_of(c[2]);
  const std::uint32_t e = value_of(c[3]);
  return ((a | b | d | e) & kBad) | a << 18U | b << 12U | d << 6U | e;
}

Error bad_character(std::string_view text, std::size_t at) {
  const char c = text[at];
  if (c == '=') {
    return {fmt::format("Character {} of the base64 text is '=', which is only allowed at the end.",
                        at + 1)};
  }
  const std::string_view shown = text.substr(at, bytes_of_code_points(text.substr(at), 1));
  return {fmt::format("Character {} of the base64 text is {}, which is not in the base64 alphabet.",
                      at + 1, quoted(shown))};
}

Error first_bad(std::string_view text, std::size_t from) {
  while (from + 1 < text.size() && value_of(text[from]) != kBad) ++from;
  return bad_character(text, from);
}

std::size_t padding_of(std::string_view text) {
  if (text.ends_with("==")) return 2;
  return text.ends_with('=') ? 1 : 0;
}

/// The last 2 or 3 characters before the padding.
Result<std::string> decode_tail(std::string_view text, std::size_t from, std::size_t padding) {
  if (padding == 0) return std::string();
  std::array<char, 4> padded{'A', 'A', 'A', 'A'};
  text.copy(padded.data(), 4 - padding, from);
  const std::uint32_t bits = quartet(padded.data());
  if ((bits & kBad) != 0) return first_bad(text, from);
  const std::uint32_t spare = padding == 2 ? 0xFFFFU : 0xFFU;
  if ((bits & spare) != 0) {
    return Error{fmt::format("Character {} of the base64 text has unused bits that are not zero.",
                             text.size() - padding)};
  }
  std::string tail(1, static_cast<char>(bits >> 16U));
  if (padding == 1) tail += static_cast<char>((bits >> 8U) & 0xFFU);
  return tail;
}

Error wrong_length(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (value_of(text[i]) == kBad && (text[i] != '=' || i + 2 < text.size())) {
      return bad_character(text, i);
    }
  }
  return {
      fmt::format("The base64 text has {} characters, which is not a multiple of 4; characters or "
                  "padding ('=') are missing.",
                  text.size())};
}

}  // namespace

Result<std::string> decode_base64(std::string_view text) {
  if (text.size() % 4 != 0) return wrong_length(text);
  const std::size_t padding = padding_of(text);
  const std::size_t whole = padding == 0 ? text.size() : text.size() - 4;
  std::string bytes;
  bytes.resize(whole / 4 * 3);
  char* to = bytes.data();
  for (std::size_t i = 0; i < whole; i += 4, to += 3) {
    const std::uint32_t bits = quartet(text.data() + i);
    if ((bits & kBad) != 0) return first_bad(text, i);
    to[0] = static_cast<char>(bits >> 16U);
    to[1] = static_cast<char>((bits >> 8U) & 0xFFU);
    to[2] = static_cast<char>(bits & 0xFFU);
  }
  Result<std::string> tail = decode_tail(text, whole, padding);
  if (!tail) return tail;
  bytes += *tail;
  return bytes;
}

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  while (!bytes.empty()) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size());
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < count; ++i) {
      group |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (16 - 8 * i);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      text += i <= count ? kAlphabet[group >> (18 - 6 * i) & 63U] : '=';
    }
    bytes.remove_prefix(count);
  }
  return text;
}

std::string data_uri(std::string_view media_type, std::string_view bytes) {
  std::string uri("data:");
  return uri.append(media_type).append(";base64,").append(encode_base64(bytes));
}

}  // namespace gltfx::container

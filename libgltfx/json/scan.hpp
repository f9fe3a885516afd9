// SPDX-License-Identifier: Apache-2.0
/// The innermost loops of the parser: from a byte to the end of the token that begins there.
///
/// Each scanner relies on the NUL after a SharedText: it stops there without a check of the end.
/// `end` is checked only before eight bytes are read at once.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace gltfx::json {

/// The tokens that a byte may be part of; a byte can be in several classes.
enum ByteClass : std::uint8_t {
  kSpace = 1,      ///< blank, tab, line feed, carriage return
  kDigit = 2,      ///< 0 to 9
  kStringEnd = 4,  ///< ends or escapes in a string: quote, backslash, control character
  kWord = 8,       ///< part of a number or of a word like `true`
};

constexpr std::array<std::uint8_t, 256> make_byte_classes() {
  std::array<std::uint8_t, 256> classes{};
  for (int c = 0; c < 256; ++c) {
    std::uint8_t bits = 0;
    const bool digit = c >= '0' && c <= '9';
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') bits |= kSpace;
    if (digit) bits |= kDigit;
    if (c == '"' || c == '\\' || c < 0x20) bits |= kStringEnd;
    if (digit || letter || c == '_' || c == '$' || c == '+' || c == '-' || c == '.') bits |= kWord;
    classes[static_cast<std::size_t>(c)] = bits;
  }
  return classes;
}
inline constexpr std::array<std::uint8_t, 256> kByteClasses = make_byte_classes();

inline bool is_a(ByteClass wanted, char c) {
  return (kByteClasses[static_cast<unsigned char>(c)] & wanted) != 0;
}

/// Whether a number may begin with `c`.
inline bool starts_number(char c) { return is_a(kDigit, c) || c == '-'; }

inline constexpr std::uint64_t kOnes = 0x0101010101010101;
inline constexpr std::uint64_t kHighs = 0x8080808080808080;

/// Eight bytes, the first one lowest.
inline std::uint64_t load8(const char* p) {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, p, sizeof bytes);
  if constexpr (std::endian::native == std::endian::big) {
    std::uint64_t swapped = 0;
    for (int i = 0; i < 8; ++i) swapped = swapped << 8 | (bytes >> (8 * i) & 0xFF);
    return swapped;
  }
  return bytes;
}

/// Whether two texts are equal: names, for which a call of memcmp() takes longer than this.
inline bool is_same(std::string_view a, std::string_view b) {
  const std::size_t size = a.size();
  if (size != b.size()) return false;
  if (size < 8) {
    for (std::size_t i = 0; i < size; ++i) {
      if (a[i] != b[i]) return false;
    }
    return true;
  }
  for (std::size_t i = 0; i + 8 < size; i += 8) {
    if (load8(a.data() + i) != load8(b.data() + i)) return false;
  }
  return load8(a.data() + size - 8) == load8(b.data() + size - 8);
}

/// High bit of each byte that is zero; reliable up to and including the first one.
inline std::uint64_t zero_bytes(std::uint64_t bytes) { return (bytes - kOnes) & ~bytes & kHighs; }

/// Index of the first byte whose high bit is set. Precondition: there is one.
inline int first_marked(std::uint64_t marks) { return std::countr_zero(marks) >> 3; }

/// High bit of each byte that is not a plain character of a string; reliable up to and including
/// the first one.
inline std::uint64_t string_ends(std::uint64_t bytes) {
  const std::uint64_t control = (bytes - kOnes * 0x20) & ~bytes & kHighs;
  return control | zero_bytes(bytes ^ (kOnes * '"')) | zero_bytes(bytes ^ (kOnes * '\\'));
}

inline const char* skip_space(const char* p, const char* end) {
  while (is_a(kSpace, *p)) {
    ++p;
    // Indentation is mostly blanks: eight are passed at once.
    if (end - p < 8) continue;
    const std::uint64_t other = load8(p) ^ (kOnes * ' ');
    p += other == 0 ? 8 : std::countr_zero(other) >> 3;
  }
  return p;
}

/// The first byte from `p` on that is not a plain character of a string.
inline const char* skip_plain_string(const char* p, const char* end) {
  while (end - p >= 8) {
    const std::uint64_t marks = string_ends(load8(p));
    if (marks != 0) return p + first_marked(marks);
    p += 8;
  }
  while (!is_a(kStringEnd, *p)) ++p;
  return p;
}

inline const char* skip_digits(const char* p, const char* end) {
  while (end - p >= 8) {
    const std::uint64_t digits = load8(p) ^ (kOnes * '0');
    // A byte above 9 carries into its high bit; bytes do not carry into one another.
    const std::uint64_t marks = (((digits & ~kHighs) + kOnes * 0x76) | digits) & kHighs;
    if (marks != 0) return p + first_marked(marks);
    p += 8;
  }
  while (is_a(kDigit, *p)) ++p;
  return p;
}

inline constexpr double kPowersOfTen[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                          1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// Reads the number literal at `p` if it has up to 15 digits and no exponent, and returns its end;
/// null for others. Precondition: one begins there. So many digits are exact in a double, and so is
/// the power of ten that a fraction divides them by: one division rounds once (Clinger, "How to
/// read floating point numbers accurately", 1990).
inline const char* scan_short_decimal(const char* p, const char* end, double& value) {
  constexpr std::ptrdiff_t kMostDigits = 15;
  const bool negative = *p == '-';
  if (negative) ++p;
  const char* const first = p;
  std::uint64_t digits = 0;  // may overflow if there are too many
  for (; p < end && is_a(kDigit, *p); ++p) digits = digits * 10 + static_cast<unsigned>(*p - '0');
  std::ptrdiff_t decimals = 0;
  if (p < end && *p == '.') {
    const char* const point = p;
    for (++p; p < end && is_a(kDigit, *p); ++p) {
      digits = digits * 10 + static_cast<unsigned>(*p - '0');
    }
    decimals = p - point - 1;
  }
  if (p - first > kMostDigits || (p < end && is_a(kWord, *p))) return nullptr;
  value = static_cast<double>(static_cast<std::int64_t>(digits)) / kPowersOfTen[decimals];
  if (negative) value = -value;
  return p;
}

struct NumberScan {
  const char* end = nullptr;  ///< null: not a number of RFC 8259 section 6
  bool may_overflow = false;  ///< long enough, or with an exponent, to exceed a double's range
};

inline NumberScan scan_number(const char* p, const char* end) {
  constexpr std::ptrdiff_t kSafeDigits = 300;
  if (*p == '-') ++p;
  const char* const digits = p;
  p = skip_digits(p, end);
  if (p == digits || (*digits == '0' && p - digits > 1)) return {};
  bool may_overflow = p - digits > kSafeDigits;
  if (*p == '.') {
    const char* const fraction = p + 1;
    p = skip_digits(fraction, end);
    if (p == fraction) return {};
  }
  if (*p == 'e' || *p == 'E') {
    ++p;
    if (*p == '+' || *p == '-') ++p;
    const char* const exponent = p;
    p = skip_digits(exponent, end);
    if (p == exponent) return {};
    may_overflow = true;
  }
  if (is_a(kWord, *p)) return {};
  return {p, may_overflow};
}

}  // namespace gltfx::json

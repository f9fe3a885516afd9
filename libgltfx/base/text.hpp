// SPDX-License-Identifier: Apache-2.0
/// Text that comes from an asset is never trusted: it is measured, cut and neutralised here. UTF-8
/// as in RFC 3629.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace gltfx {

/// The code point at one place of a text.
struct CodePoint {
  std::uint32_t value = 0;  ///< the code point; of an invalid byte the byte itself
  std::uint32_t size = 1;   ///< bytes taken, 1 to 4; 1 for an invalid byte
  bool valid = false;       ///< false: truncated, overlong, a surrogate, or beyond U+10FFFF
};

/// Decodes the code point that begins at byte `at`. Precondition: at < text.size().
CodePoint decode_utf8(std::string_view text, std::size_t at);

/// Appends a code point. Precondition: a Unicode scalar value.
void append_utf8(std::string& out, std::uint32_t code_point);

/// `text` with control characters (C0, C1, DEL), bidirectional overrides and invalid UTF-8 shown
/// as visible escapes ("\u001b", "\x80"), so that it can neither drive a terminal nor fake a line.
/// A tab becomes one space. One code point in gives at least one out.
std::string printable(std::string_view text);

/// `text` in single quotes, printable, cut to at most `limit` code points with an ellipsis.
std::string quoted(std::string_view text, std::size_t limit = 60);

/// Code points of a UTF-8 text; a byte that is not a valid lead counts as one.
std::size_t count_code_points(std::string_view text);

/// The inverse of count_code_points(): bytes of the first `code_points` code points of `text`.
std::size_t bytes_of_code_points(std::string_view text, std::size_t code_points);

/// The candidate nearest to `word` by Damerau-Levenshtein distance (case counts half) and at most
/// two edits away; if there is none, the only one that differs in case and '_' alone; or empty.
std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates);

/// "a", "a or b", "a, b or c"; more than `limit` items end in "or N others".
std::string join_or(std::span<const std::string> items, std::size_t limit = 8);

/// "a", "a and b", "a, b and c".
std::string join_and(std::span<const std::string> items);

/// ASCII letters in lower case.
constexpr char ascii_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
std::string lower_case(std::string_view text);

/// The sentence without its full stop, if it has one.
std::string_view without_stop(std::string_view sentence);

/// A sentence of a decoder or the system as a part of another sentence: printable, without its full
/// stop.
std::string half_sentence(std::string_view sentence);

/// The text with its first ASCII letter, if it is the first character, as a capital.
std::string capitalized(std::string text);

/// The file name extension in lower case, with its dot: ".glb". Empty without a dot.
std::string ending_of(std::string_view path);

/// Whether the extension is that of a GLB: ".glb" or ".vrm".
bool has_glb_ending(std::string_view path);

}  // namespace gltfx

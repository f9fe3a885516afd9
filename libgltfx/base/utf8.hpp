// SPDX-License-Identifier: Apache-2.0
/// One code point in, one code point out: UTF-8 as RFC 3629 has it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gltfx {

/// What stands at one place of a text.
struct CodePoint {
  std::uint32_t value = 0;  ///< the code point; of an invalid byte the byte itself
  std::uint32_t size = 1;   ///< bytes taken, 1 to 4; an invalid byte stands alone
  bool valid = false;       ///< false: truncated, overlong, a surrogate, or beyond U+10FFFF
};

/// Decodes the code point that begins at byte `at`. Precondition: at < text.size().
CodePoint decode_utf8(std::string_view text, std::size_t at);

/// Appends a code point. Precondition: a Unicode scalar value.
void append_utf8(std::string& out, std::uint32_t code_point);

}  // namespace gltfx

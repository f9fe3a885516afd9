// SPDX-License-Identifier: Apache-2.0
/// Canonical Huffman codes in the form of BasisLZ (KTX 2.0, "Compressed Huffman Tables").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bit_reader.hpp"

namespace gltfx::codec {

class HuffmanTable {
 public:
  /// A table without codes.
  HuffmanTable() = default;
  /// From the code length of each symbol in bits, 0 to 16; 0: the symbol has no code.
  explicit HuffmanTable(std::span<const std::uint8_t> lengths);

  /// Whether the codes of all symbols are different.
  bool is_sound() const { return sound_; }
  /// The next symbol. If the bits are not a code, sets the reader to failed and returns 0.
  std::uint32_t decode(BitReader& bits) const;

 private:
  static constexpr unsigned kLongest = 16;
  static constexpr unsigned kFast = 10;
  struct Code {
    std::uint16_t symbol = 0;
    std::uint8_t length = 0;  ///< 0: none
  };
  Code find(std::uint32_t bits, unsigned longest) const;

  std::array<std::uint16_t, kLongest + 1> counts_{};  ///< number of codes of each length
  std::vector<std::uint16_t> symbols_;                ///< in the order of their codes
  std::vector<Code> fast_;                            ///< by the next kFast bits
  bool sound_ = true;
};

/// Reads the lengths of codes, which are coded themselves. A table without symbols is empty:
/// encoders write such tables for unused models. Invalid tables set the reader to failed.
HuffmanTable read_huffman_table(BitReader& bits);

}  // namespace gltfx::codec

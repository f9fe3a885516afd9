// SPDX-License-Identifier: Apache-2.0
#include "basis_huffman.hpp"

#include <algorithm>

namespace gltfx::codec {

// RFC 1951 section 3.2.2: shorter codes come first, and codes of one length by their symbols.
HuffmanTable::HuffmanTable(std::span<const std::uint8_t> lengths) {
  for (const std::uint8_t length : lengths) ++counts_[length];
  counts_[0] = 0;
  std::array<std::size_t, kLongest + 2> first{};  // position of the first symbol of each length
  std::uint32_t room = 1;                         // free codes of this length
  for (unsigned length = 1; length <= kLongest; ++length) {
    room *= 2;
    sound_ = sound_ && counts_[length] <= room;
    room -= std::min<std::uint32_t>(room, counts_[length]);
    first[length + 1] = first[length] + counts_[length];
  }
  symbols_.resize(first[kLongest + 1]);
  for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
    const std::uint8_t length = lengths[symbol];
    if (length != 0) symbols_[first[length]++] = static_cast<std::uint16_t>(symbol);
  }
  if (!sound_ || symbols_.empty()) return;
  fast_.resize(std::size_t{1} << kFast);
  for (std::size_t i = 0; i < fast_.size(); ++i) {
    fast_[i] = find(static_cast<std::uint32_t>(i), kFast);
  }
}

// The code at the begin of `bits`, whose first bit is the lowest one.
HuffmanTable::Code HuffmanTable::find(std::uint32_t bits, unsigned longest) const {
  std::uint32_t code = 0, first = 0;  // bits so far; the first code of this length
  std::size_t before = 0;             // number of shorter codes
  for (unsigned length = 1; length <= longest; ++length) {
    code = code << 1U | (bits & 1U);
    bits >>= 1U;
    first <<= 1U;
    if (code < first + counts_[length]) {
      return {symbols_[before + code - first], static_cast<std::uint8_t>(length)};
    }
    before += counts_[length];
    first += counts_[length];
  }
  return {};
}

std::uint32_t HuffmanTable::decode(BitReader& bits) const {
  Code code;
  if (!fast_.empty()) {
    code = fast_[bits.peek(kFast)];
    if (code.length == 0) code = find(bits.peek(kLongest), kLongest);
  }
  if (code.length == 0) bits.fail();
  bits.skip(code.length);
  return code.symbol;
}

namespace {

constexpr std::array<std::uint8_t, 21> kOrder{17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                              11, 4,  12, 3,  13, 2, 14, 1, 15, 16};

// Symbols of the small table above the lengths themselves: runs of zeros, or of the previous
// length.
struct Run {
  unsigned bits, least;
  bool zeros;
};
constexpr std::uint32_t kFirstRun = 17;
constexpr std::array<Run, 4> kRuns{{{3, 3, true}, {7, 11, true}, {2, 3, false}, {7, 7, false}}};

std::vector<std::uint8_t> read_lengths(BitReader& bits, const HuffmanTable& small,
                                       std::size_t count) {
  std::vector<std::uint8_t> lengths;
  lengths.reserve(count);
  while (lengths.size() < count && bits.ok()) {
    const std::uint32_t symbol = small.decode(bits);
    if (symbol < kFirstRun) {
      lengths.push_back(static_cast<std::uint8_t>(symbol));
      continue;
    }
    const Run& run = kRuns[symbol - kFirstRun];
    const std::size_t repeats = run.least + bits.take(run.bits);
    const std::uint8_t before = lengths.empty() ? std::uint8_t{0} : lengths.back();
    if (repeats > count - lengths.size() || (!run.zeros && before == 0)) {
      bits.fail();
      break;
    }
    lengths.insert(lengths.end(), repeats, run.zeros ? std::uint8_t{0} : before);
  }
  return lengths;
}

HuffmanTable sound(HuffmanTable table, BitReader& bits) {
  if (!table.is_sound()) bits.fail();
  return bits.ok() ? std::move(table) : HuffmanTable();
}

}  // namespace

HuffmanTable read_huffman_table(BitReader& bits) {
  const std::size_t symbols = bits.take(14);
  if (symbols == 0) return {};
  const std::size_t codes = bits.take(5);
  if (codes < 1 || codes > kOrder.size()) {
    bits.fail();
    return {};
  }
  std::array<std::uint8_t, kOrder.size()> sizes{};
  for (std::size_t i = 0; i < codes; ++i) {
    sizes[kOrder[i]] = static_cast<std::uint8_t>(bits.take(3));
  }
  const HuffmanTable small = sound(HuffmanTable(sizes), bits);
  const std::vector<std::uint8_t> lengths = read_lengths(bits, small, symbols);
  return bits.ok() ? sound(HuffmanTable(lengths), bits) : HuffmanTable();
}

}  // namespace gltfx::codec

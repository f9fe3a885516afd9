// SPDX-License-Identifier: Apache-2.0
#include "basis_codebooks.hpp"

namespace gltfx::codec {
namespace {

constexpr std::uint32_t kColorMask = 31, kModifiersMask = 7;

// The codes of colour differences: one for dark, one for middle and one for bright previous values.
struct ColorDeltas {
  std::array<HuffmanTable, 3> tables;

  void add_next(BitReader& bits, std::uint8_t& value) const {
    const std::size_t range = value < 10 ? 0 : value < 22 ? 1 : 2;
    value = static_cast<std::uint8_t>((value + tables[range].decode(bits)) & kColorMask);
  }
};

}  // namespace

std::optional<std::vector<Etc1sEndpoint>> read_endpoints(std::span<const std::byte> bytes,
                                                         std::uint16_t count) {
  BitReader bits(bytes);
  ColorDeltas deltas;
  for (HuffmanTable& table : deltas.tables) table = read_huffman_table(bits);
  const HuffmanTable modifiers = read_huffman_table(bits);
  const bool grey = bits.take(1) != 0;
  std::vector<Etc1sEndpoint> endpoints;
  endpoints.reserve(count);
  Etc1sEndpoint now{{16, 16, 16}, 0};
  while (endpoints.size() < count && bits.ok()) {
    now.modifiers =
        static_cast<std::uint8_t>((now.modifiers + modifiers.decode(bits)) & kModifiersMask);
    deltas.add_next(bits, now.color[0]);
    if (grey) {
      now.color[1] = now.color[2] = now.color[0];
    } else {
      deltas.add_next(bits, now.color[1]);
      deltas.add_next(bits, now.color[2]);
    }
    endpoints.push_back(now);
  }
  if (!bits.ok()) return std::nullopt;
  return endpoints;
}

std::optional<std::vector<Etc1sSelector>> read_selectors(std::span<const std::byte> bytes,
                                                         std::uint16_t count) {
  BitReader bits(bytes);
  if (bits.take(2) != 0) return std::nullopt;  // reserved
  const bool raw = bits.take(1) != 0;
  const HuffmanTable deltas = raw ? HuffmanTable() : read_huffman_table(bits);
  std::vector<Etc1sSelector> selectors;
  selectors.reserve(count);
  Etc1sSelector now{};
  while (selectors.size() < count && bits.ok()) {
    const bool whole = raw || selectors.empty();
    for (std::uint8_t& row : now) {
      row = static_cast<std::uint8_t>(whole ? bits.take(8) : row ^ deltas.decode(bits));
    }
    selectors.push_back(now);
  }
  if (!bits.ok()) return std::nullopt;
  return selectors;
}

std::optional<Etc1sSliceCodes> read_slice_codes(std::span<const std::byte> bytes) {
  BitReader bits(bytes);
  Etc1sSliceCodes codes;
  codes.endpoint_prediction = read_huffman_table(bits);
  codes.endpoint_delta = read_huffman_table(bits);
  codes.selector = read_huffman_table(bits);
  codes.selector_run = read_huffman_table(bits);
  codes.history_size = bits.take(13);
  if (!bits.ok()) return std::nullopt;
  return codes;
}

}  // namespace gltfx::codec

// SPDX-License-Identifier: Apache-2.0
/// Data that all images of a BasisLZ file share: endpoints, selectors, and the codes of slices (KTX
/// 2.0, "ETC1S Endpoint Codebooks" to "ETC1S Slice Huffman Tables").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "basis_huffman.hpp"

namespace gltfx::codec {

/// The colour of a block and the distances of its texels from it.
struct Etc1sEndpoint {
  std::array<std::uint8_t, 3> color{};  ///< R, G and B, 5 bits each
  std::uint8_t modifiers = 0;           ///< number of a table, 0 to 7
};

/// Two bits per texel: a byte per row, from the top, the left texel lowest.
using Etc1sSelector = std::array<std::uint8_t, 4>;

struct Etc1sCodebooks {
  std::vector<Etc1sEndpoint> endpoints;
  std::vector<Etc1sSelector> selectors;
};

struct Etc1sSliceCodes {
  HuffmanTable endpoint_prediction, endpoint_delta, selector, selector_run;
  std::uint32_t history_size = 0;  ///< number of selectors in it
};

// Nothing if the bytes are invalid. Needs 4 bytes of memory per entry.

std::optional<std::vector<Etc1sEndpoint>> read_endpoints(std::span<const std::byte> bytes,
                                                         std::uint16_t count);
std::optional<std::vector<Etc1sSelector>> read_selectors(std::span<const std::byte> bytes,
                                                         std::uint16_t count);
std::optional<Etc1sSliceCodes> read_slice_codes(std::span<const std::byte> bytes);

}  // namespace gltfx::codec

// SPDX-License-Identifier: Apache-2.0
/// The blocks of one BasisLZ slice (KTX 2.0, "ETC1S Slice Decoding"). Only still images: blocks
/// that an animation copies from the previous frame are not supported.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "basis_codebooks.hpp"

namespace gltfx::codec {

/// Entries of the codebooks.
struct Etc1sBlock {
  std::uint16_t endpoint = 0, selector = 0;
};

/// The last used selectors, ordered roughly by use ("ETC1S Approximate Move to Front Routines").
class SelectorHistory {
 public:
  explicit SelectorHistory(std::size_t size) : values_(size), next_(size / 2) {}

  std::size_t size() const { return values_.size(); }
  void add(std::uint16_t selector);
  /// Returns the selector at `index` and moves it halfway to the front. Precondition: `index` is
  /// below size().
  std::uint16_t use(std::size_t index);

 private:
  std::vector<std::uint16_t> values_;
  std::size_t next_;  ///< position for a new one: in the second half
};

/// Decodes a slice row by row. Keeps references to codes and codebooks.
class Etc1sSlice {
 public:
  Etc1sSlice(const Etc1sSliceCodes& codes, const Etc1sCodebooks& codebooks,
             std::span<const std::byte> bytes, std::size_t blocks_across);

  /// Decodes the next row, from the top. Permanently false if the bytes are corrupt or truncated.
  bool next_row(std::span<Etc1sBlock> row);

 private:
  std::uint32_t next_predictions();
  void read_block(std::size_t x, std::uint32_t prediction, std::span<Etc1sBlock> row);
  std::uint16_t read_endpoint(std::size_t x, std::uint32_t prediction, std::uint16_t left);
  std::uint16_t read_selector();
  std::uint16_t from_history(std::size_t index);

  const Etc1sSliceCodes& codes_;
  const Etc1sCodebooks& codebooks_;
  BitReader bits_;
  std::vector<Etc1sBlock> above_;           ///< the previous row; empty before the first
  std::vector<std::uint8_t> for_odd_rows_;  ///< predictions of two blocks each
  bool odd_row_ = false;
  std::uint32_t predictions_ = 0;  ///< last read predictions, for four blocks
  std::uint64_t prediction_repeats_ = 0;
  std::uint16_t endpoint_before_ = 0;   ///< of the previous block
  std::uint64_t selector_repeats_ = 0;  ///< for the first entry of the history
  SelectorHistory history_;
};

}  // namespace gltfx::codec

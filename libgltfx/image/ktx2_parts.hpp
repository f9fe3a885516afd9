// SPDX-License-Identifier: Apache-2.0
/// The parts of a KTX2 file, one after the other. Each reads what it can and records errors.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/checked.hpp"
#include "image/cursor.hpp"
#include "image/ktx2.hpp"

namespace gltfx::image {

inline constexpr std::uint64_t kKtx2HeaderBytes = 80;
inline constexpr std::uint64_t kKtx2LevelBytes = 24;

/// A sample of the basic descriptor block.
struct Ktx2Sample {
  std::uint32_t offset = 0, bits = 0;
  std::uint8_t channel = 0;
  bool is_float = false, is_signed = false;
};

/// A file during reading. Ranges are inside the bytes, or empty.
struct Ktx2Reading {
  std::span<const std::byte> bytes;
  Ktx2& file;
  Ktx2Range descriptor, metadata, global;
  /// A member of the basic descriptor block.
  std::uint8_t color_model = 0;
  std::array<std::uint8_t, 2> plane_bytes{};  ///< of a texel block in the first two planes
  std::vector<Ktx2Sample> samples;

  void error(Code code, std::string problem) {
    file.errors.push_back({code, std::move(problem), false});
  }
  void tolerated_error(Code code, std::string problem) {
    file.errors.push_back({code, std::move(problem), true});
  }
  bool has_scheme(Ktx2Scheme scheme) const {
    return file.scheme == static_cast<std::uint32_t>(scheme);
  }
  Cursor at(std::uint64_t offset) const {
    return Cursor(bytes.subspan(static_cast<std::size_t>(offset)));
  }
  Cursor within(const Ktx2Range& range) const {
    return Cursor(bytes.subspan(static_cast<std::size_t>(range.offset),
                                static_cast<std::size_t>(range.length)));
  }
};

void read_ktx2_descriptor(Ktx2Reading& reading);
void read_ktx2_metadata(Ktx2Reading& reading);
/// vkFormat and typeSize against each other and against the descriptor, which has been read.
void check_ktx2_format(Ktx2Reading& reading);
/// Levels against extents, model and scheme. Header and descriptor have been read.
void check_ktx2_levels(Ktx2Reading& reading);
/// The global data of BasisLZ. Levels have been read.
void check_ktx2_global(Ktx2Reading& reading);

/// Layers times faces.
std::uint64_t elements_of(const Ktx2& file);
/// Images of one level: elements times slices of a volume.
Checked images_of_level(const Ktx2& file, std::size_t level);

}  // namespace gltfx::image

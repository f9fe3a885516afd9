// SPDX-License-Identifier: Apache-2.0
/// Statistics over the texels of an image, row by row, without keeping the image.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "codec/client.hpp"

namespace gltfx::codec {

/// Computes the statistics in `Image`.
class Statistics {
 public:
  /// Takes format and size from `image`; `normals` also measures vectors, if there are three
  /// channels.
  Statistics(const Image& image, bool normals);

  /// Adds whole texels, in any order: packed, 8 or 16 bits per channel in the machine's byte order.
  void add(std::span<const std::byte> texels);

  /// Writes statistics, `grey` and `normals`. Precondition: all texels have been added.
  void finish(Image& image) const;

 private:
  // Lanes hold whole texels of 1, 2, 3 and 4 channels.
  static constexpr std::size_t kLanes = 48;
  static constexpr std::size_t kBlock = 256;
  /// The components of kBlock vectors.
  struct Vectors {
    const std::array<float, kBlock>&x, &y, &z;
  };
  template <typename T>
  void add_texels(const T* values, std::size_t count);
  template <typename T>
  void add_rest(const T* values, std::size_t count);
  template <typename T>
  void add_normals(const T* values, std::size_t count);
  void measure(const Vectors& vectors, std::size_t count);
  void note(std::size_t channel, std::uint32_t least, std::uint32_t greatest);

  std::size_t channels_;
  std::uint32_t full_;
  bool with_normals_;
  std::array<ChannelStatistics, 4> channel_{};
  bool grey_ = true;
  std::uint64_t vectors_ = 0, not_unit_ = 0, far_off_ = 0, inward_ = 0;
  double length_sum_ = 0;
  float steepest_ = 0;
};

}  // namespace gltfx::codec

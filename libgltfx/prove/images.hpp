// SPDX-License-Identifier: Apache-2.0
/// Compares the contents of images.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "codec/client.hpp"
#include "prove/differences.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// Red, green, blue, alpha.
using Texel = std::array<double, 4>;

/// The texels of an image from 0 to 255, or as floats. Grey counts as three equal channels, missing
/// alpha as opaque. Keeps a reference.
class Texels {
 public:
  explicit Texels(const codec::Image& image) : image_(image) {}
  Texel at(std::size_t texel) const;

 private:
  bool has_floats() const { return image_.bits == 32; }
  double number(std::size_t at) const;

  const codec::Image& image_;
};

/// An image with its pixels, or why there is none. Precondition: it has bytes.
std::variant<codec::Image, std::string> decode_image(const Side& side, std::size_t image);

/// The greatest difference of two images.
struct TexelDifference {
  std::uint32_t x = 0, y = 0;
  double steps = 0;  ///< in steps of 255; for floats the plain difference
};
/// "is 1 of 255 steps away"; `floats`: of images with those.
std::string distance_text(const TexelDifference& difference, bool floats);

/// Compares decoded images with pixels. Grey counts as three equal channels, missing alpha as
/// opaque; nothing if all texels are equal. Precondition: images of the same size, both or neither
/// with floats.
std::optional<TexelDifference> compare_texels(const codec::Image& ours, const codec::Image& theirs);

/// `pair`: objects of images. Not for ImageComparison::none.
void compare_images(const Side& before, const Side& after, const Pair& pair,
                    ImageComparison comparison, Differences& found);

}  // namespace gltfx::prove

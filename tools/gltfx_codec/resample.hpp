// SPDX-License-Identifier: Apache-2.0
/// Changes the number of float texels, mostly to fewer ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "codec/image_options.hpp"

namespace gltfx::codec {

/// Texels along one side, before and after, and the wrapping at its ends.
struct Side {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Wrap wrap = Wrap::repeat;
};

/// The texel, 0 to `count` - 1, for `index`.
std::uint32_t wrapped(std::int64_t index, std::uint32_t count, Wrap wrap);

/// Fills a row of the input with `channels` floats per texel. Called once per row, from the top.
using LoadRow = std::function<void(std::uint32_t row, std::span<float> to)>;

/// The filter of Mitchell and Netravali ("Reconstruction filters in computer graphics", 1988; B and
/// C are 1/3), along rows and then along columns. Each result is clamped to the range of the texels
/// with positive weights. `channels`: 1 to 4. Throws std::bad_alloc.
std::vector<float> resample(const Side& across, const Side& down, unsigned channels,
                            const LoadRow& load);

}  // namespace gltfx::codec

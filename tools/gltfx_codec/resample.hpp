// SPDX-License-Identifier: Apache-2.0
/// Averages texels of floats to fewer ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "codec/image_options.hpp"

namespace gltfx::codec {

/// Texels along one side, before and after, and what lies beyond its ends.
struct Side {
  std::uint32_t from = 0;
  std::uint32_t to = 0;  ///< at most `from`
  Wrap wrap = Wrap::repeat;
};

/// The texel of 0 to `count` - 1 that `index` stands for.
std::uint32_t wrapped(std::int64_t index, std::uint32_t count, Wrap wrap);

/// Fills a row of the input with `channels` floats a texel. Rows are asked for once, from the top.
using LoadRow = std::function<void(std::uint32_t row, std::span<float> to)>;

/// The filter of Mitchell and Netravali ("Reconstruction filters in computer graphics", 1988; B and
/// C are 1/3), along rows and then along columns, each result clamped to the least and greatest of
/// the texels that count positively. `channels`: 1 to 4. Throws std::bad_alloc.
std::vector<float> resample(const Side& across, const Side& down, unsigned channels,
                            const LoadRow& load);

}  // namespace gltfx::codec

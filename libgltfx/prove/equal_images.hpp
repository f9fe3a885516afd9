// SPDX-License-Identifier: Apache-2.0
/// Textures whose images have equal texels in other files.
#pragma once

#include <map>
#include <utility>

#include "prove/changes.hpp"

namespace gltfx::prove {

/// Decodes images where it is asked about them, each pair once.
class EqualImages {
 public:
  explicit EqualImages(const Comparison& comparison) : all_(comparison) {}

  /// Whether both are images, or textures, with all values and all texels equal.
  bool are_equal(ItemId ours, ItemId theirs);

 private:
  bool have_equal_texels(std::uint32_t ours, std::uint32_t theirs) const;

  const Comparison& all_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> known_;
};

}  // namespace gltfx::prove

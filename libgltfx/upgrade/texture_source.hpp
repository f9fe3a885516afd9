// SPDX-License-Identifier: Apache-2.0
/// Which image a texture shows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "model/asset.hpp"
#include "upgrade/pictures.hpp"

namespace gltfx::upgrade {

struct TextureSource {
  std::uint64_t image = 0;               ///< index into the root's images
  std::optional<std::uint64_t> sampler;  ///< as the texture has it
  std::string problem;                   ///< why no image can be read, without stop; else empty
  std::string note;                      ///< that the fallback was read; else empty
};

/// The image of an extension of the texture if that can be read, because readers that know the
/// extension show it; else the texture's own `source`. Images with the same bytes count as one.
TextureSource texture_source(const model::Asset& asset, std::uint64_t texture, Pictures& pictures);

}  // namespace gltfx::upgrade

// SPDX-License-Identifier: Apache-2.0
/// Which image a texture shows, and textures whose image has the right values in another channel
/// than the successor of their slot reads.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "model/asset.hpp"
#include "steps/upgrade/image_job.hpp"
#include "steps/upgrade/pictures.hpp"

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

struct ChannelMove {
  enum class Kind : std::uint8_t {
    impossible,  ///< `problem` says why
    reuse,       ///< the image has the same values in both channels
    repack,      ///< a new image is made
  };
  Kind kind = Kind::impossible;
  std::string problem, note;             ///< without stop; may be empty
  std::optional<double> constant;        ///< the value in all texels, if it is one: 0 to 1
  bool target_varies = false;            ///< the channel that is read from now on is not constant
  ImageJob job;                          ///< Kind::repack: white but for the moved channel
  std::optional<std::uint64_t> sampler;  ///< that the texture has
  std::uint64_t image = 0;               ///< that it shows
};

/// `swizzle` is "r>a": what stands in R is read in A. Null pictures make it impossible.
ChannelMove check_channel_move(const model::Asset& asset, std::uint64_t texture,
                               std::string_view swizzle, Pictures* pictures);

}  // namespace gltfx::upgrade

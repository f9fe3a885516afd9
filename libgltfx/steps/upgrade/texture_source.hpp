// SPDX-License-Identifier: Apache-2.0
/// The image of a texture, and textures whose image has the right values in another channel than
/// the one that the successor of their slot reads.
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
  std::optional<std::uint64_t> sampler;  ///< sampler of the texture
  std::string problem;  ///< why no image can be read, without a full stop; otherwise empty
  std::string note;     ///< set if the fallback was read; otherwise empty
};

/// The image in an extension of the texture if it can be read, because readers with that extension
/// show it; otherwise the texture's `source`. Images with the same bytes count as one.
TextureSource texture_source(const model::Asset& asset, std::uint64_t texture, Pictures& pictures);

struct ChannelMove {
  enum class Kind : std::uint8_t {
    impossible,  ///< see `problem`
    reuse,       ///< the image has the same values in both channels
    repack,      ///< a new image is made
  };
  Kind kind = Kind::impossible;
  std::string problem, note;             ///< without a full stop; may be empty
  std::optional<double> constant;        ///< the value of all texels if they are equal: 0 to 1
  bool target_varies = false;            ///< the newly read channel is not constant
  ImageJob job;                          ///< Kind::repack: white except for the moved channel
  std::optional<std::uint64_t> sampler;  ///< sampler of the texture
  std::uint64_t image = 0;               ///< image of the texture
};

/// `swizzle` is "r>a": the data of R is read from A. With null pictures the result is impossible.
ChannelMove check_channel_move(const model::Asset& asset, std::uint64_t texture,
                               std::string_view swizzle, Pictures* pictures);

}  // namespace gltfx::upgrade

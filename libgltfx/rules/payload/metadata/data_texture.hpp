// SPDX-License-Identifier: Apache-2.0
/// Textures with texels that are not colors: feature IDs and property textures.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "codec/client.hpp"
#include "model/mesh.hpp"
#include "rules/payload/metadata/phase.hpp"

namespace gltfx::validate {

/// A texture info with channels.
struct DataTexture {
  std::optional<std::uint32_t> image;  ///< an image with a header
  std::vector<unsigned> channels;      ///< channels of the image; empty: a channel is missing
  std::uint64_t channel_count = 1;     ///< number of listed channels
};

/// Reads and checks a texture info: whether its image can be read, channels missing in the image,
/// and filters of the sampler. `nearest`: filters must not mix texels.
DataTexture check_data_texture(MetadataPhase& phase, json::NodeId object, const Path& path,
                               bool nearest);

/// The n of TEXCOORD_n that a texture info reads; nothing if it is malformed.
std::optional<std::uint64_t> texcoord_set(const json::Document& document, json::NodeId object);

/// The n of all TEXCOORD_n of a primitive, sorted.
std::vector<std::uint64_t> texcoord_sets(const Context& context, json::NodeId primitive);

/// Reports at `place` and `path` that a primitive lacks TEXCOORD_n.
void report_missing_texcoord(MetadataPhase& phase, std::uint64_t set, json::NodeId place,
                             const Path& path);

/// A request for the texels of an image.
struct TexelRequest {
  std::uint32_t image = 0;
  std::function<void(const codec::Image&)> use;
  json::NodeId object = json::kNoNode;  ///< the texture info, and its place
  std::string pointer;
};
/// Decodes each image once and passes it to all requests, as far as pixels are requested. Images
/// with a bit depth other than 8 are skipped; those that cannot be decoded are reported.
void read_texels(MetadataPhase& phase, std::vector<TexelRequest> requests);

/// Calls `use(bytes, texels)` with blocks of texels with only the given channels, in that order.
/// Nothing if the image lacks one of them.
void for_each_texel_block(const codec::Image& image, const std::vector<unsigned>& channels,
                          const std::function<void(std::span<const std::byte>, std::size_t)>& use);

}  // namespace gltfx::validate

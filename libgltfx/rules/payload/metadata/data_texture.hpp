// SPDX-License-Identifier: Apache-2.0
/// Textures whose texels are no colours: feature ids and property textures.
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
  std::optional<std::uint32_t> image;  ///< that has a header
  std::vector<unsigned> channels;      ///< that the image has; empty: there are others
  std::uint64_t channel_count = 1;     ///< as listed
};

/// Reads and checks one: whether there is an image that can be read, channels that it does not
/// have, and filters of the sampler.
/// `nearest`: no filter may mix texels.
DataTexture check_data_texture(MetadataPhase& phase, json::NodeId object, const Path& path,
                               bool nearest);

/// The n of TEXCOORD_n that a texture info reads; nothing when it is malformed.
std::optional<std::uint64_t> texcoord_set(const json::Document& document, json::NodeId object);

/// The n of all TEXCOORD_n of a primitive, sorted.
std::vector<std::uint64_t> texcoord_sets(const Context& context, json::NodeId primitive);

/// Reports at `place` and `path` that a primitive lacks TEXCOORD_n.
void report_missing_texcoord(MetadataPhase& phase, std::uint64_t set, json::NodeId place,
                             const Path& path);

/// Somebody who wants to see the texels of an image.
struct TexelRequest {
  std::uint32_t image = 0;
  std::function<void(const codec::Image&)> use;
  json::NodeId object = json::kNoNode;  ///< the texture info, and its place
  std::string pointer;
};
/// Decodes each image once and hands it to all that asked, as far as pixels are asked for. Images
/// with other than 8 bits a channel are left out; those that cannot be decoded are reported.
void read_texels(MetadataPhase& phase, std::vector<TexelRequest> requests);

/// Calls `use(bytes, texels)` with blocks of texels of which only some channels are kept, in that
/// order. Nothing when the image does not have all of them.
void for_each_texel_block(const codec::Image& image, const std::vector<unsigned>& channels,
                          const std::function<void(std::span<const std::byte>, std::size_t)>& use);

}  // namespace gltfx::validate

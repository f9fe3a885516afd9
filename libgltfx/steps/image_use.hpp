// SPDX-License-Identifier: Apache-2.0
/// Determines the use of images.
#pragma once

#include <gltfx/convert.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codec/image_options.hpp"
#include "graph/graph.hpp"
#include "model/asset.hpp"

namespace gltfx::steps {

/// The use of an image by all texture slots that refer to it.
struct ImageUse {
  std::optional<ImageClass> kind;  ///< nothing: unknown or ambiguous
  std::string doubt;               ///< why there is no kind, half a sentence
  bool alpha = false;              ///< a slot reads alpha
  bool coverage = false;           ///< alpha is the opacity of a surface
  float alpha_cutoff = 0;          ///< of all such surfaces; 0: none, or different values
  codec::Wrap wrap_u = codec::Wrap::clamp;
  codec::Wrap wrap_v = codec::Wrap::clamp;
};

/// JSON pointers of references that are not texture slots of a schema, by the index of their
/// target. In objects without a schema, references are guessed from the names of members.
struct OtherUsers {
  std::map<std::uint32_t, std::string> of_images;  ///< except sources of textures
  std::map<std::uint32_t, std::string> of_textures;
};

/// Precondition of both: the graph has slots.
OtherUsers other_users(const model::Asset& asset, const graph::Graph& graph);

/// The use of each of `count` groups of images. `groups`: the group of each image.
std::vector<ImageUse> image_uses(const model::Asset& asset, const graph::Graph& graph,
                                 const OtherUsers& others, const std::vector<std::size_t>& groups,
                                 std::size_t count);

/// One use for each image. Precondition: the graph has slots.
std::vector<ImageUse> image_uses(const model::Asset& asset, const graph::Graph& graph);

}  // namespace gltfx::steps

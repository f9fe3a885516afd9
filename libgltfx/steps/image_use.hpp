// SPDX-License-Identifier: Apache-2.0
/// What the images of an asset are used as.
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

/// The union of all texture slots that lead to an image.
struct ImageUse {
  std::optional<ImageClass> kind;  ///< nothing: unknown, or more than one
  std::string doubt;               ///< why there is no kind, half a sentence
  bool alpha = false;              ///< a slot reads it
  bool coverage = false;           ///< alpha is that of a surface that is not opaque
  float alpha_cutoff = 0;          ///< all such surfaces have this one; 0: none, or several
  codec::Wrap wrap_u = codec::Wrap::clamp;
  codec::Wrap wrap_v = codec::Wrap::clamp;
};

/// References that are no texture slot of a schema, by the index of what they lead to: JSON
/// pointers. Those of objects without a schema are guessed by the names of members.
struct OtherUsers {
  std::map<std::uint32_t, std::string> of_images;  ///< that are no source of a texture
  std::map<std::uint32_t, std::string> of_textures;
};

/// Precondition of both: the graph has slots.
OtherUsers other_users(const model::Asset& asset, const graph::Graph& graph);

/// One use for each of `count` groups of images. `groups`: of each image, its group.
std::vector<ImageUse> image_uses(const model::Asset& asset, const graph::Graph& graph,
                                 const OtherUsers& others, const std::vector<std::size_t>& groups,
                                 std::size_t count);

}  // namespace gltfx::steps

// SPDX-License-Identifier: Apache-2.0
/// What a material reads of vertices and images.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "prove/content.hpp"
#include "prove/soup.hpp"

namespace gltfx::prove {

struct TextureUse {
  std::set<std::uint64_t> sets;  ///< the n of each TEXCOORD_n
  bool normals_mapped = false;   ///< a texture needs tangents
  bool unlit = false;            ///< needs no normals
  bool opaque = true;            ///< needs no alpha of vertex colors
  double texels = 1;             ///< the longest side of its images; without them, of all images

  /// Whether anything is drawn with that attribute.
  bool reads(const SoupStream& stream) const;
  /// The numbers of a vertex that are drawn.
  unsigned read_width(const SoupStream& stream) const;
};
/// By material; the last one is that of no material.
std::vector<TextureUse> texture_uses(const Content& content);

/// The channels of an image that materials read, and as what.
struct ImageUse {
  bool color = false, normal = false, data = false;
  bool channels[4] = {false, false, false, false};
  std::optional<double> cutoff;  ///< the lowest one of masked materials
  bool used() const { return channels[0] || channels[1] || channels[2] || channels[3]; }
};
/// By image.
std::vector<ImageUse> image_uses(const Content& content);

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
/// Where the texels of a texture slot come to lie on a surface.
#pragma once

#include <array>
#include <string_view>

#include "json/document.hpp"

namespace gltfx::validate {

/// The set of texture coordinates, and how they are transformed (KHR_texture_transform, or whatever
/// extension of the texture info has such members).
struct UvMapping {
  double texcoord = 0;
  double rotation = 0;  ///< radians
  std::array<double, 2> offset{0, 0}, scale{1, 1};

  /// The first thing that differs, as it is called in the text; empty: nothing does.
  std::string_view difference(const UvMapping& other) const;
};

UvMapping read_uv_mapping(const json::Document& document, json::NodeId texture_info);

}  // namespace gltfx::validate

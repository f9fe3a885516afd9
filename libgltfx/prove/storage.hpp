// SPDX-License-Identifier: Apache-2.0
/// Parts of the schemas about storage, not about meaning.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "schema/set.hpp"

namespace gltfx::prove {

/// Types of objects whose content is compared in a special way.
struct Types {
  explicit Types(const schema::Set& set);
  schema::TypeId accessor, animation, asset, buffer, buffer_view, channel, image, node, primitive,
      root, sampler, scene, skin, texture;
};

/// Extensions that store geometry or images differently, or in more formats: they refer to a buffer
/// view from a primitive, to a buffer from a view, to an image from a texture, or have no objects
/// and add formats of attributes. The decoders that they need are not part of the meaning.
std::set<std::string, std::less<>> storage_extensions(const schema::Set& set, const Types& types);

}  // namespace gltfx::prove

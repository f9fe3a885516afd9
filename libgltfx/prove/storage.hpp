// SPDX-License-Identifier: Apache-2.0
/// What the schemas tell of how something is stored, and not of what it is.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "schema/set.hpp"

namespace gltfx::prove {

/// Types of objects that the comparison treats by what they hold.
struct Types {
  explicit Types(const schema::Set& set);
  schema::TypeId accessor, buffer, buffer_view, channel, image, node, primitive, root, sampler,
      texture;
};

/// Extensions that store geometry or images in another way, or in more formats: they refer to a
/// buffer view from a primitive, to a buffer from a view, to an image from a texture, or have no
/// objects and add formats to attributes. Which decoder they take is no part of the meaning.
std::set<std::string, std::less<>> storage_extensions(const schema::Set& set, const Types& types);

}  // namespace gltfx::prove

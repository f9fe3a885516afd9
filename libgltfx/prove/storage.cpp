// SPDX-License-Identifier: Apache-2.0
#include "prove/storage.hpp"

#include <algorithm>

namespace gltfx::prove {
namespace {

// Whether objects of a shape have a member that is an index into that root array.
bool refers_to(const schema::Set& set, schema::ShapeId shape, std::string_view array) {
  const schema::TypeId type = set.shape(shape).type;
  if (type == schema::kNone) return false;
  const auto& properties = set.type(type).properties;
  return std::any_of(properties.begin(), properties.end(), [&](const schema::Property& property) {
    if (property.shape == schema::kNone) return false;
    const auto& target = set.shape(property.shape).ref;
    return target && target->base == schema::Target::Base::root_array &&
           target->steps.size() == 1 && target->steps.front() == array;
  });
}

bool stores(const schema::Set& set, const Types& types, const schema::Extension& extension) {
  if (extension.attachment_points.empty()) {
    return !extension.vertex_attributes.empty() || !extension.morph_attributes.empty();
  }
  return std::any_of(extension.attachment_points.begin(), extension.attachment_points.end(),
                     [&](const auto& point) {
                       const auto& [type, shape] = point;
                       if (type == types.primitive) return refers_to(set, shape, "bufferViews");
                       if (type == types.texture) return refers_to(set, shape, "images");
                       return type == types.buffer_view && refers_to(set, shape, "buffers");
                     });
}

}  // namespace

Types::Types(const schema::Set& set)
    : accessor(set.find_type("accessor")),
      animation(set.find_type("animation")),
      asset(set.find_type("asset")),
      buffer(set.find_type("buffer")),
      buffer_view(set.find_type("bufferView")),
      channel(set.find_type("animation.channel")),
      image(set.find_type("image")),
      node(set.find_type("node")),
      primitive(set.find_type("mesh.primitive")),
      root(set.find_type("glTF")),
      sampler(set.find_type("animation.sampler")),
      scene(set.find_type("scene")),
      skin(set.find_type("skin")),
      texture(set.find_type("texture")) {}

std::set<std::string, std::less<>> storage_extensions(const schema::Set& set, const Types& types) {
  std::set<std::string, std::less<>> names;
  for (const schema::Extension& extension : set.extensions()) {
    if (stores(set, types, extension)) names.insert(extension.name);
  }
  return names;
}

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
#include "upgrade/texture_source.hpp"

#include <vector>

#include <fmt/format.h>

#include "model/fields.hpp"

namespace gltfx::upgrade {
namespace {

std::vector<std::uint64_t> images_of(const json::Document& document, json::NodeId texture) {
  std::vector<std::uint64_t> images;
  const auto add = [&](json::NodeId object) {
    const auto source = model::unsigned_member(document, object, "source");
    if (source) images.push_back(*source);
  };
  const json::NodeId extensions = model::object_member(document, texture, "extensions");
  if (extensions != json::kNoNode) {
    for (const auto extension : document.members(extensions)) add(extension.value);
  }
  add(texture);
  return images;
}

}  // namespace

TextureSource texture_source(const model::Asset& asset, std::uint64_t texture, Pictures& pictures) {
  TextureSource source;
  const auto& textures = asset.elements(model::RootArray::textures);
  const json::NodeId object = texture < textures.size() ? textures[texture] : json::kNoNode;
  std::vector<std::uint64_t> images;
  if (object != json::kNoNode) {
    source.sampler = model::unsigned_member(asset.document(), object, "sampler");
    images = images_of(asset.document(), object);
  }
  source.problem = fmt::format("texture {} has no image", texture);
  std::string first_problem;
  for (const std::uint64_t image : images) {
    const Picture& picture = pictures.picture(image);
    if (picture.problem.empty()) {
      source.image = pictures.same_as(image);
      source.problem.clear();
      source.note = first_problem;
      return source;
    }
    std::string problem = fmt::format("image {}: {}", image, picture.problem);
    if (first_problem.empty()) first_problem = std::move(problem);
  }
  if (!first_problem.empty()) source.problem = std::move(first_problem);
  return source;
}

}  // namespace gltfx::upgrade

// SPDX-License-Identifier: Apache-2.0
#include "steps/upgrade/texture_source.hpp"

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

constexpr std::string_view kLetters = "rgba";

std::uint8_t channel_of(char letter) { return static_cast<std::uint8_t>(kLetters.find(letter)); }

// Whether two channels are known to be equal in all texels.
bool are_equal(const Picture& picture, std::uint8_t one, std::uint8_t other) {
  if (one == 0 && kLetters[other] == 'a' && picture.alpha_is_red) return true;
  const codec::ChannelStatistics a = picture.statistics(one);
  const codec::ChannelStatistics b = picture.statistics(other);
  return a.constant() && b.constant() && a.least == b.least;
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

ChannelMove check_channel_move(const model::Asset& asset, std::uint64_t texture,
                               std::string_view swizzle, Pictures* pictures) {
  ChannelMove move;
  if (pictures == nullptr) {
    move.problem = "the pixels of its image are not available";
    return move;
  }
  TextureSource source = texture_source(asset, texture, *pictures);
  if (!source.problem.empty()) {
    move.problem = std::move(source.problem);
    return move;
  }
  const Picture& picture = pictures->picture(source.image);
  const std::uint8_t from = channel_of(swizzle.front());
  const std::uint8_t to = channel_of(swizzle.back());
  const codec::ChannelStatistics moved = picture.statistics(from);
  if (moved.constant()) {
    move.constant = static_cast<double>(moved.least) / static_cast<double>(picture.image.full());
  }
  move.note = std::move(source.note);
  move.target_varies = !picture.statistics(to).constant();
  move.sampler = source.sampler;
  move.image = source.image;
  move.kind = are_equal(picture, from, to) ? ChannelMove::Kind::reuse : ChannelMove::Kind::repack;
  for (ChannelSource& channel : move.job.channels) channel = ChannelSource::constant(1);
  move.job.channels[to] = ChannelSource::of(source.image, from);
  return move;
}

}  // namespace gltfx::upgrade

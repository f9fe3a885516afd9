// SPDX-License-Identifier: Apache-2.0
#include "model/animation.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::array<std::string_view, 3> kInterpolations{"LINEAR", "STEP", "CUBICSPLINE"};
constexpr std::array<std::string_view, 4> kPaths{"translation", "rotation", "scale", "weights"};

std::vector<json::NodeId> objects_of(const json::Document& document, json::NodeId array) {
  std::vector<json::NodeId> objects;
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return objects;
  for (const json::NodeId element : document.elements(array)) {
    if (!document.is_object(element)) return {};
    objects.push_back(element);
  }
  return objects;
}

Interpolation read_interpolation(const json::Document& document, json::NodeId sampler) {
  if (!document.has_value(sampler, "interpolation")) return Interpolation::linear;
  const std::string name = string_member(document, sampler, "interpolation");
  const auto* const found = std::find(kInterpolations.begin(), kInterpolations.end(), name);
  return static_cast<Interpolation>(found - kInterpolations.begin());
}

AnimationPath read_path(const json::Document& document, json::NodeId target) {
  const std::string name = string_member(document, target, "path");
  if (name.empty()) return AnimationPath::none;
  const auto* const found = std::find(kPaths.begin(), kPaths.end(), name);
  return static_cast<AnimationPath>(found - kPaths.begin() + 1);
}

AnimationChannel read_channel(const Asset& asset, json::NodeId object, std::size_t samplers) {
  const json::Document& document = asset.document();
  AnimationChannel channel;
  channel.object = object;
  const auto sampler = unsigned_member(document, object, "sampler");
  if (sampler && *sampler < samplers) channel.sampler = static_cast<std::uint32_t>(*sampler);
  channel.target = object_member(document, object, "target");
  channel.node = asset.index(channel.target, "node", RootArray::nodes);
  channel.path = read_path(document, channel.target);
  return channel;
}

Animation read_animation(const Asset& asset, json::NodeId object) {
  const json::Document& document = asset.document();
  Animation animation;
  animation.object = object;
  for (const json::NodeId sampler : objects_of(document, document.find(object, "samplers"))) {
    animation.samplers.push_back({sampler, asset.index(sampler, "input", RootArray::accessors),
                                  asset.index(sampler, "output", RootArray::accessors),
                                  read_interpolation(document, sampler)});
  }
  for (const json::NodeId channel : objects_of(document, document.find(object, "channels"))) {
    animation.channels.push_back(read_channel(asset, channel, animation.samplers.size()));
  }
  return animation;
}

}  // namespace

std::string_view interpolation_name(Interpolation interpolation) {
  const auto at = static_cast<std::size_t>(interpolation);
  return at < kInterpolations.size() ? kInterpolations[at] : std::string_view();
}

std::string_view animation_path_name(AnimationPath path) {
  if (path == AnimationPath::none || path == AnimationPath::other) return {};
  return kPaths[static_cast<std::size_t>(path) - 1];
}

std::uint64_t values_per_keyframe(Interpolation interpolation) {
  return interpolation == Interpolation::cubic_spline ? 3 : 1;
}

std::vector<Animation> read_animations(const Asset& asset) {
  std::vector<Animation> animations;
  animations.reserve(asset.count(RootArray::animations));
  for (const json::NodeId object : asset.elements(RootArray::animations)) {
    animations.push_back(object == json::kNoNode ? Animation() : read_animation(asset, object));
  }
  return animations;
}

}  // namespace gltfx::model

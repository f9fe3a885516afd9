// SPDX-License-Identifier: Apache-2.0
/// Animations: samplers with their keyframes and channels with their targets (specification
/// section 3.11).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "model/node.hpp"

namespace gltfx::model {

enum class Interpolation : std::uint8_t { linear, step, cubic_spline, unknown };
/// "CUBICSPLINE"; empty for unknown.
std::string_view interpolation_name(Interpolation interpolation);

/// The target of a channel: a property of a node, or of an extension.
enum class AnimationPath : std::uint8_t { none, translation, rotation, scale, weights, other };
/// "translation"; empty for none and other.
std::string_view animation_path_name(AnimationPath path);

/// A curve. Broken indices are empty.
struct AnimationSampler {
  json::NodeId object = json::kNoNode;
  std::optional<std::uint32_t> input;   ///< accessor with the times in seconds
  std::optional<std::uint32_t> output;  ///< accessor with the values
  Interpolation interpolation = Interpolation::linear;
};

struct AnimationChannel {
  json::NodeId object = json::kNoNode;
  std::optional<std::uint32_t> sampler;  ///< position in `samplers` of the animation
  json::NodeId target = json::kNoNode;   ///< object
  std::optional<NodeIndex> node;         ///< of the target
  AnimationPath path = AnimationPath::none;
};

/// One animation. A list with an element that is not an object is empty.
struct Animation {
  json::NodeId object = json::kNoNode;
  std::vector<AnimationSampler> samplers;
  std::vector<AnimationChannel> channels;
};

/// All animations, in the order of the root array. `object` is json::kNoNode for an element that is
/// not an object.
std::vector<Animation> read_animations(const Asset& asset);

/// Number of values in a sampler's output per keyframe of a property with one value: 3 for
/// CUBICSPLINE (in-tangent, value, out-tangent), otherwise 1.
std::uint64_t values_per_keyframe(Interpolation interpolation);

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
#include "rules/khronos/animation_paths.hpp"

#include "model/fields.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {
namespace {

// Steps that remain after all animations are prepended to all later pointers.
void leave_animations(const Context& context) {
  const auto& animations = context.views.animations;
  if (context.order == nullptr || animations.empty()) return;
  AnimationPaths paths;
  for (std::size_t i = 0; i < animations.size(); ++i) {
    const model::Animation& animation = animations[i];
    if (animation.object == json::kNoNode || !is_linked(context, animation)) continue;
    paths.push(static_cast<std::uint64_t>(i));
    paths.push("channels");
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      if (!has_sampler_index(context, animation.channels[c])) paths.push(std::uint64_t{c});
    }
    paths.pop();
    paths.pop();
  }
  paths.pop();
  if (paths.path().parent() != nullptr) context.order->report_below(paths.path());
}

}  // namespace

bool has_sampler_index(const Context& context, const model::AnimationChannel& channel) {
  return model::unsigned_member(context.document, channel.object, "sampler").has_value();
}

bool is_linked(const Context& context, const model::Animation& animation) {
  const bool incomplete = animation.channels.empty() || animation.samplers.empty();
  return !incomplete || !context.deviations.incomplete_animations_are_unlinked;
}

const RuleGroup& animation_paths_rules() {
  static constexpr LinkRule kLinkRules[] = {leave_animations};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// KHR_animation_pointer: channels that name their property by a JSON pointer. Only the object model
// lists these properties, so the rules exceed what a schema file can state; this file is about that
// one extension and names it.
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/animation.hpp"
#include "model/fields.hpp"
#include "model/object_model.hpp"
#include "rules/context.hpp"
#include "rules/core/animation_output.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"
#include "rules/khronos/animation_paths.hpp"

namespace gltfx::validate {
namespace {

using model::AnimationChannel;
using model::PropertyTarget;
using model::PropertyType;

constexpr std::string_view kAnimationPointerExtension = "KHR_animation_pointer";
constexpr std::string_view kPath = "pointer";

// The channels that write a property, as a whole or element by element: channel numbers of one
// animation.
struct Claims {
  std::optional<std::size_t> whole;
  std::optional<std::size_t> any_element;
  std::map<std::uint64_t, std::size_t> elements;

  // The channel that conflicts with this one; this one is entered if there is none.
  std::optional<std::size_t> claim(std::size_t channel, std::optional<std::uint64_t> element) {
    if (whole) return whole;
    if (!element) {
      whole = channel;
      return any_element;
    }
    any_element = any_element.value_or(channel);
    const auto [known, fresh] = elements.try_emplace(*element, channel);
    return fresh ? std::nullopt : std::optional(known->second);
  }
};
using ClaimsByProperty = std::unordered_map<std::string, Claims>;

// The element type of an output accessor for a data type (the extension's table).
model::ElementType element_type(PropertyType type) {
  switch (type) {
    case PropertyType::float2:
      return model::ElementType::vec2;
    case PropertyType::float3:
      return model::ElementType::vec3;
    case PropertyType::float4:
      return model::ElementType::vec4;
    case PropertyType::float2x2:
      return model::ElementType::mat2;
    case PropertyType::float3x3:
      return model::ElementType::mat3;
    case PropertyType::float4x4:
      return model::ElementType::mat4;
    default:
      return model::ElementType::scalar;
  }
}

bool is_discrete(PropertyType type) {
  return type == PropertyType::boolean || type == PropertyType::integer;
}

bool fits(PropertyType type, const model::Format& format) {
  if (!format.known()) return true;
  if (format.type != element_type(type)) return false;
  if (type == PropertyType::boolean) return format.component == model::ComponentType::uint8;
  if (type == PropertyType::integer)
    return model::is_integer(format.component) && !format.normalized;
  return true;
}

std::string wanted_format(PropertyType type) {
  const std::string_view element = model::element_type_name(element_type(type));
  if (type == PropertyType::boolean) return fmt::format("{} of UNSIGNED_BYTE", element);
  if (type == PropertyType::integer) {
    return fmt::format("{} of integers, not normalized", element);
  }
  return std::string(element);
}

class PointerCheck {
 public:
  explicit PointerCheck(const Context& context)
      : context_(context), model_(context.asset, context.schemas) {}

  void run() {
    const Path root;
    const Path list(root, "animations");
    const auto& animations = context_.views.animations;
    for (std::size_t i = 0; i < animations.size(); ++i) {
      if (animations[i].object != json::kNoNode) check(animations[i], Path(list, i));
    }
  }

 private:
  void check(const model::Animation& animation, const Path& path) {
    ClaimsByProperty claims;
    enter_plain_targets(animation, claims);
    const Path channels(path, "channels");
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
      const AnimationChannel& channel = animation.channels[i];
      const Path at(channels, i);
      const json::NodeId extension =
          model::extension_object(context_.document, channel.target, kAnimationPointerExtension);
      if (extension == json::kNoNode) {
        check_plain(channel, at);
        continue;
      }
      const Path target(at, "target");
      const Path extensions(target, "extensions");
      const Path place(extensions, kAnimationPointerExtension);
      const bool followed = !context_.deviations.animation_pointers_are_not_followed;
      if (!followed) {
        report_link(context_, place, extension, Code::INCOMPLETE_EXTENSION_SUPPORT,
                    "The pointer is not checked in this profile.");
      }
      check_target(channel, is_linked(context_, animation), place);
      if (followed) check_pointer(animation, i, extension, place, at, claims);
    }
  }

  static void enter_plain_targets(const model::Animation& animation, ClaimsByProperty& claims) {
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
      const AnimationChannel& channel = animation.channels[i];
      const std::string_view path = model::animation_path_name(channel.path);
      // Two equal core targets are reported by the rules on animations.
      if (channel.node && !path.empty()) {
        claims[fmt::format("/nodes/{}/{}", *channel.node, path)].claim(i, std::nullopt);
      }
    }
  }

  void check_plain(const AnimationChannel& channel, const Path& path) {
    if (model::string_member(context_.document, channel.target, "path") != kPath) return;
    report_link(context_, Path(path, "target"), channel.target, Code::ANIMATION_POINTER_MISSING,
                fmt::format("The path is 'pointer', but the target has no {}.",
                            kAnimationPointerExtension));
  }

  void check_target(const AnimationChannel& channel, bool linked, const Path& place) {
    const Deviations& deviations = context_.deviations;
    const json::NodeId node = context_.document.find(channel.target, "node");
    const bool given = node != json::kNoNode && context_.document.unsigned_integer(node);
    if (deviations.broken_values_are_absent ? linked && channel.node : given) {
      report_link(context_, place, node, Code::KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE,
                  "The target has both a pointer and a node.");
    }
    const json::NodeId path = context_.document.find(channel.target, "path");
    const bool text = path != json::kNoNode && context_.document.is_string(path);
    if (!text && !deviations.consequences_are_reported) return;
    const std::string name = text ? context_.document.string(path) : std::string();
    if (name == kPath) return;
    report_link(context_, place, path, Code::KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH,
                fmt::format("The path is {}; it must be 'pointer'.", gltfx::quoted(name)));
  }

  void check_pointer(const model::Animation& animation, std::size_t index, json::NodeId extension,
                     const Path& place, const Path& channel_path, ClaimsByProperty& claims) {
    const json::NodeId value = context_.document.find(extension, "pointer");
    if (value == json::kNoNode || !context_.document.is_string(value)) return;
    const std::string text = context_.document.string(value);
    const PropertyTarget target = model_.resolve(text);
    const Path at(place, "pointer");
    const std::string help =
        target.nearest.empty() ? std::string() : fmt::format("did you mean {}?", target.nearest);
    switch (target.status) {
      case PropertyTarget::Status::malformed:
        return;  // reported by the schema walk
      case PropertyTarget::Status::unresolved:
        report_link(context_, at, value, Code::ANIMATION_POINTER_UNRESOLVED,
                    fmt::format("The pointer does not resolve: {}.", target.reason), help);
        return;
      case PropertyTarget::Status::immutable:
        report_link(
            context_, at, value, Code::ANIMATION_POINTER_NOT_MUTABLE,
            fmt::format("The target of the pointer cannot be animated: {}.", target.reason));
        return;
      default:
        break;
    }
    const auto other = claims[target.property].claim(index, target.element);
    if (other) report_duplicate(at, value, *other);
    // With another path, which is reported, that path defines the output.
    const bool heeded =
        model::string_member(context_.document, animation.channels[index].target, "path") == kPath;
    if (heeded && target.status == PropertyTarget::Status::mutable_property) {
      check_sampler(animation, animation.channels[index], target, channel_path);
    }
  }

  void report_duplicate(const Path& at, json::NodeId value, std::size_t other) {
    report_link(context_, at, value, Code::ANIMATION_POINTER_DUPLICATE,
                fmt::format("Channel {} has the same target.", other));
  }

  void check_sampler(const model::Animation& animation, const AnimationChannel& channel,
                     const PropertyTarget& target, const Path& path) {
    if (!channel.sampler) return;
    const model::AnimationSampler& sampler = animation.samplers[*channel.sampler];
    const bool interpolates = sampler.interpolation == model::Interpolation::linear ||
                              sampler.interpolation == model::Interpolation::cubic_spline;
    if (is_discrete(target.type) && interpolates) {
      report_member(context_.link_sink, context_, path, channel.object, "sampler",
                    Code::ANIMATION_POINTER_INTERPOLATION,
                    fmt::format("{} has type {}, which cannot be interpolated, but the "
                                "interpolation of sampler {} is {}.",
                                printable(target.property), property_type_name(target.type),
                                *channel.sampler, interpolation_name(sampler.interpolation)));
      return;
    }
    if (!sampler.output) return;
    if (!fits(target.type, context_.views.accessors[*sampler.output].format)) {
      report_output_format(
          context_, sampler,
          fmt::format("{} ({})", printable(target.property), property_type_name(target.type)),
          wanted_format(target.type), channel.object, path);
    }
    const bool list = target.type == PropertyType::number_array;
    check_output_count(context_, sampler, list ? target.length : 1, channel.object, path);
  }

  const Context& context_;
  model::ObjectModel model_;
};

void check_pointers(const Context& context) {
  if (!ActiveExtensions(context).contains(kAnimationPointerExtension)) return;
  if (context.asset.count(model::RootArray::animations) != 0) PointerCheck(context).run();
}

}  // namespace

const RuleGroup& animation_pointer_rules() {
  static constexpr LinkRule kLinkRules[] = {check_pointers};
  static constexpr FixEntry kFixes[] = {
      {Code::KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE, remove_marked}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate

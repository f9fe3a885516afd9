// SPDX-License-Identifier: Apache-2.0
#include "rules/core/animation_output.hpp"

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::AnimationPath;
using model::ComponentType;
using model::ElementType;

bool is_float(const model::Format& format) {
  return format.component == ComponentType::float32 && !format.normalized;
}

bool is_float_or_small_normalized(const model::Format& format) {
  if (is_float(format)) return true;
  return format.normalized && model::component_size(format.component) <= 2;
}

}  // namespace

bool fits_path(AnimationPath path, const model::Format& format) {
  switch (path) {
    case AnimationPath::translation:
    case AnimationPath::scale:
      return format.type == ElementType::vec3 && is_float(format);
    case AnimationPath::rotation:
      return format.type == ElementType::vec4 && is_float_or_small_normalized(format);
    case AnimationPath::weights:
      return format.type == ElementType::scalar && is_float_or_small_normalized(format);
    default:
      return true;
  }
}

std::string_view path_formats_text(AnimationPath path) {
  switch (path) {
    case AnimationPath::translation:
    case AnimationPath::scale:
      return "VEC3 of FLOAT";
    case AnimationPath::rotation:
      return "VEC4 of FLOAT or normalized bytes or shorts";
    case AnimationPath::weights:
      return "SCALAR of FLOAT or normalized bytes or shorts";
    default:
      return "";
  }
}

std::optional<std::uint64_t> expected_outputs(const Context& context,
                                              const model::AnimationSampler& sampler,
                                              std::uint64_t values) {
  if (!sampler.input) return std::nullopt;
  const auto keyframes = context.views.accessors[*sampler.input].count;
  if (!keyframes) return std::nullopt;
  const auto vectors = checked_mul(*keyframes, model::values_per_keyframe(sampler.interpolation));
  return vectors ? checked_mul(*vectors, values) : std::nullopt;
}

void check_output_count(const Context& context, const model::AnimationSampler& sampler,
                        std::uint64_t values, json::NodeId channel, const Path& channel_path) {
  if (!sampler.output) return;
  if (sampler.interpolation == model::Interpolation::unknown) {
    // An unknown name, which is reported, is not CUBICSPLINE.
    const bool named = context.document.find(sampler.object, "interpolation") != json::kNoNode;
    if (!named || !context.deviations.consequences_are_reported) return;
  }
  const auto found = context.views.accessors[*sampler.output].count;
  const auto expected = expected_outputs(context, sampler, values);
  if (!found || !expected || *expected == 0 || *found == *expected) return;
  const auto keyframes = *context.views.accessors[*sampler.input].count;
  std::string reckoning = fmt::format("{} keyframe{}", keyframes, keyframes == 1 ? "" : "s");
  if (sampler.interpolation == model::Interpolation::cubic_spline) {
    reckoning += " with two tangents each";
  }
  if (values != 1) reckoning += fmt::format(" of {} values", values);
  report_member(context.link_sink, context, channel_path, channel, "sampler",
                Code::ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT,
                fmt::format("Output accessor {} has {} elements; it must have {}, for {}.",
                            *sampler.output, *found, *expected, reckoning));
}

void report_output_format(const Context& context, const model::AnimationSampler& sampler,
                          std::string_view what, std::string_view wanted, json::NodeId channel,
                          const Path& channel_path) {
  report_member(
      context.link_sink, context, channel_path, channel, "sampler",
      Code::ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT,
      fmt::format("Output accessor {} for {} is {}; it must be {}.", *sampler.output, what,
                  format_text(context.views.accessors[*sampler.output].format), wanted));
}

}  // namespace gltfx::validate

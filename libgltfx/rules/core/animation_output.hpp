// SPDX-License-Identifier: Apache-2.0
/// The format and count that an animation sampler's output must have for its target.
#pragma once

#include <cstdint>
#include <optional>

#include "model/accessor.hpp"
#include "model/animation.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// Whether an accessor with that format can be the output for a path of core glTF. True for unknown
/// formats and for paths of extensions.
bool fits_path(model::AnimationPath path, const model::Format& format);
/// "VEC4 of FLOAT or of normalized bytes or shorts".
std::string_view path_formats_text(model::AnimationPath path);

/// The number of output elements for a sampler whose property has `values` numbers or vectors per
/// keyframe, or nothing if the times are unknown or there are too many.
std::optional<std::uint64_t> expected_outputs(const Context& context,
                                              const model::AnimationSampler& sampler,
                                              std::uint64_t values);

/// Compares the output's count with expected_outputs() and reports
/// ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT at `sampler` of the channel.
void check_output_count(const Context& context, const model::AnimationSampler& sampler,
                        std::uint64_t values, json::NodeId channel, const Path& channel_path);

/// Reports ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT at `sampler` of the channel.
void report_output_format(const Context& context, const model::AnimationSampler& sampler,
                          std::string_view what, std::string_view wanted, json::NodeId channel,
                          const Path& channel_path);

}  // namespace gltfx::validate

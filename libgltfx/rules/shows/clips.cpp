// SPDX-License-Identifier: Apache-2.0
// Animations as a whole.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/elements.hpp"
#include "model/keyframes.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using model::RootArray;

bool has_duration(const Context& context, const model::Animation& animation) {
  return std::any_of(animation.samplers.begin(), animation.samplers.end(),
                     [&](const auto& sampler) {
                       if (!sampler.input || !sampler.output) return true;  // unknown
                       if (!context.views.accessors[*sampler.output].buffer_view) return true;
                       const model::Accessor& input = context.views.accessors[*sampler.input];
                       const auto first = model::float_array<1>(context.document, input.min);
                       const auto last = model::float_array<1>(context.document, input.max);
                       return !first || !last || (*first)[0] < (*last)[0];
                     });
}

// How far the last key of a channel is from its first one; nothing: it cannot be read.
std::optional<double> gap_of(DataPhase& phase, const model::AnimationSampler& sampler,
                             bool rotation) {
  if (!sampler.input || !sampler.output) return std::nullopt;
  const auto times = phase.open(*sampler.input);
  const auto values = phase.open(*sampler.output);
  const std::uint64_t each = model::values_per_keyframe(sampler.interpolation);
  if (!times || !values || times->count() < 2 || values->count() != times->count() * each) {
    return std::nullopt;
  }
  const std::vector<float> first = model::element_at(*values, each / 2);
  const std::vector<float> last =
      model::element_at(*values, (times->count() - 1) * each + each / 2);
  double same = 0;
  double opposite = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const double a = static_cast<double>(first[k]);
    const double b = static_cast<double>(last[k]);
    same = std::max(same, std::abs(a - b));
    opposite = std::max(opposite, std::abs(a + b));
  }
  return rotation ? std::min(same, opposite) : same;
}

// A loop in which few channels do not end where they begin.
void check_loop(DataPhase& phase, std::size_t index, const model::Animation& animation) {
  constexpr std::size_t kFewest = 4;
  constexpr double kClosed = 1e-3;
  constexpr std::size_t kMostOpen = 4;  // a quarter of the channels
  std::size_t known = 0;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < animation.channels.size(); ++i) {
    const model::AnimationChannel& channel = animation.channels[i];
    if (!channel.sampler || channel.path == model::AnimationPath::weights) continue;
    const auto gap = gap_of(phase, animation.samplers[*channel.sampler],
                            channel.path == model::AnimationPath::rotation);
    if (!gap) continue;
    ++known;
    if (*gap > kClosed) open.push_back(i);
  }
  if (known < kFewest || open.empty() || open.size() * kMostOpen > known) return;
  const model::AnimationChannel& first = animation.channels[open.front()];
  report_at(phase.sink, fmt::format("/animations/{}/channels/{}", index, open.front()),
            finding_on(phase.context, first.object, Code::ANIMATION_LOOP_OPEN,
                       fmt::format(
                           "{} of {} channels end where they begin, but {} do{} not: played "
                           "as a loop, the animation jumps.",
                           known - open.size(), known, open.size(), open.size() == 1 ? "es" : "")));
}

}  // namespace

void check_clips(DataPhase& phase) {
  const bool durations = is_enabled(phase.context.options, Code::ANIMATION_WITHOUT_DURATION);
  const bool loops = is_enabled(phase.context.options, Code::ANIMATION_LOOP_OPEN);
  const auto& animations = phase.context.views.animations;
  for (std::size_t i = 0; i < animations.size(); ++i) {
    if (animations[i].channels.empty()) continue;
    if (!has_duration(phase.context, animations[i])) {
      if (!durations) continue;
      report_element(phase.sink, phase.context, RootArray::animations, i,
                     Code::ANIMATION_WITHOUT_DURATION,
                     "All keys of the animation are at one time: it is a pose, and nothing moves.");
    } else if (loops) {
      check_loop(phase, i, animations[i]);
    }
  }
}

}  // namespace gltfx::validate

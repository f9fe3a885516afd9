// SPDX-License-Identifier: Apache-2.0
#include "prove/curves.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "model/elements.hpp"
#include "model/keyframes.hpp"
#include "prove/column.hpp"

namespace gltfx::prove {
namespace {

using model::AccessorData;
using model::AnimationPath;
using model::Curve;

constexpr int kParts = 5;  // samples per interval of two keyframes
// Values that are computed from different keyframes are rounded differently.
constexpr double kRoundingPart = 1.0 / (1 << 22);

std::optional<AccessorData> open(const Side& side, const std::optional<std::uint32_t>& accessor) {
  if (!accessor) return std::nullopt;
  auto data = side.open(*accessor);
  const bool affordable = data && (!data->implied() || side.affords_implied(data->count()));
  return affordable ? std::move(data) : std::nullopt;
}

double farthest(const std::vector<float>& a, const std::vector<float>& b, double sign) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double there = sign * static_cast<double>(b[i]);
    greatest = std::max(greatest, apart(static_cast<double>(a[i]), there));
  }
  return greatest;
}

double size_of(const std::vector<float>& values) {
  double greatest = 0;
  for (const float value : values) {
    if (std::isfinite(value)) greatest = std::max(greatest, std::fabs(static_cast<double>(value)));
  }
  return greatest;
}

double size_of_all(const AccessorData& values) {
  double greatest = 0;
  model::for_each_component(values, static_cast<std::size_t>(values.count()),
                            [&](std::size_t, unsigned, float value) {
                              const double size = std::fabs(static_cast<double>(value));
                              if (std::isfinite(size)) greatest = std::max(greatest, size);
                            });
  return greatest;
}

struct Worst {
  double distance = 0;  ///< beyond rounding
  double time = 0;
};

Worst farthest_apart(const Motion& ours, const Motion& theirs) {
  Worst worst;
  const std::uint64_t count = ours.curve.times.count();
  std::vector<float> here = ours.at(ours.time(0));
  for (std::uint64_t k = 0; k < count; ++k) {
    const double begin = ours.time(k);
    const double end = k + 1 < count ? ours.time(k + 1) : begin;
    const std::vector<float> next = ours.at(end);
    const double rounding = kRoundingPart * std::max(size_of(here), size_of(next));
    for (int part = 0; part < (end > begin ? kParts : 1); ++part) {
      const double moment = begin + (end - begin) * part / kParts;
      const std::vector<float> a = ours.at(moment);
      const std::vector<float> b = theirs.at(moment);
      const double distance = value_distance(a, b, ours.path == AnimationPath::rotation);
      if (distance > rounding && distance > worst.distance) worst = {distance, moment};
    }
    here = next;
  }
  return worst;
}

}  // namespace

double Motion::time(std::uint64_t keyframe) const {
  return static_cast<double>(model::element_at(curve.times, keyframe)[0]);
}

std::optional<Sampled> find_sampled(const Side& side, json::NodeId channel) {
  const json::NodeId animation = side.tree().root_element(channel);
  if (animation == json::kNoNode) return std::nullopt;
  const model::Animation& all = side.views().animations[side.index(animation)];
  const std::size_t position = side.index(channel);
  if (position >= all.channels.size() || !all.channels[position].sampler) return std::nullopt;
  return Sampled{&all.channels[position], &all.samplers[*all.channels[position].sampler]};
}

std::optional<Motion> open_motion(const Side& side, json::NodeId channel) {
  const auto found = find_sampled(side, channel);
  if (!found) return std::nullopt;
  const model::AnimationSampler& sampler = *found->sampler;
  if (sampler.interpolation == model::Interpolation::unknown) return std::nullopt;
  auto times = open(side, sampler.input);
  auto values = open(side, sampler.output);
  if (!times || !values || times->components() != 1) return std::nullopt;
  const std::uint64_t frames = times->count() * values_per_keyframe(sampler.interpolation);
  const std::uint64_t width = values->count() / frames;
  if (width == 0) return std::nullopt;
  Motion motion{
      {*std::move(times), *std::move(values), sampler.interpolation}, width, found->channel->path};
  return motion.at(motion.time(0)).empty() ? std::nullopt : std::optional(std::move(motion));
}

double value_distance(const std::vector<float>& a, const std::vector<float>& b, bool rotation) {
  const double distance = farthest(a, b, 1);
  // A quaternion and its negative are the same rotation.
  return rotation ? std::min(distance, farthest(a, b, -1)) : distance;
}

std::string curve_key(const Side& side, json::NodeId channel) {
  const auto found = find_sampled(side, channel);
  // One that has no sampler is like no other.
  if (!found) return fmt::format("channel {}", channel);
  const model::AnimationSampler& sampler = *found->sampler;
  const auto number = [](const auto& accessor) { return accessor ? std::int64_t{*accessor} : -1; };
  return fmt::format("{} {} {} {}", static_cast<int>(found->channel->path),
                     static_cast<int>(sampler.interpolation), number(sampler.input),
                     number(sampler.output));
}

void compare_curves(const Side& before, const Side& after, const Pair& pair,
                    const Tolerance& tolerance, Differences& found) {
  const std::string place = before.pointer(pair.ours);
  const auto ours = open_motion(before, pair.ours);
  if (!ours) return found.leave_out(place, "has keyframes that cannot be read");
  const auto theirs = open_motion(after, pair.theirs);
  if (!theirs) return found.add(place, "has keyframes that can no longer be read");
  if (ours->width != theirs->width ||
      ours->curve.values.components() != theirs->curve.values.components()) {
    return found.add(place, "moves another number of values");
  }
  if (apart(ours->time(0), theirs->time(0)) > 0 || apart(ours->last(), theirs->last()) > 0) {
    return found.add(place,
                     fmt::format("lasts from {:.6g} to {:.6g} s in place of {:.6g} to {:.6g}",
                                 theirs->time(0), theirs->last(), ours->time(0), ours->last()));
  }
  const Worst worst = farthest_apart(*ours, *theirs);
  const std::string_view name = model::animation_path_name(ours->path);
  found.measure(name.empty() ? "animation" : name, worst.distance, place);
  const double size = ours->path == AnimationPath::rotation ? 1 : size_of_all(ours->curve.values);
  const double part = worst.distance > 0 ? worst.distance / size : 0;
  if (tolerance.animation_part > 0) found.measure("animation", part, place);
  if (worst.distance <= tolerance.animation || part <= tolerance.animation_part) return;
  found.add(place, fmt::format("is {:.6g} away at {:.6g} s", worst.distance, worst.time),
            worst.distance);
}

}  // namespace gltfx::prove

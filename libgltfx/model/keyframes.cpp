// SPDX-License-Identifier: Apache-2.0
#include "model/keyframes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "model/elements.hpp"
#include "model/fields.hpp"
#include "model/memory_budget.hpp"
#include "model/node.hpp"
#include "model/object_model.hpp"

namespace gltfx::model {
namespace {

constexpr std::string_view kPointerExtension = "KHR_animation_pointer";
// The number of weights of morph targets is nodes times targets, which the size of a file does not
// bound.
constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20U;

using Values = std::vector<float>;

double time_at(const Curve& curve, std::uint64_t keyframe) {
  return static_cast<double>(element_at(curve.times, keyframe)[0]);
}

// The last keyframe that is not after `time`, or the first one.
std::uint64_t keyframe_before(const Curve& curve, double time) {
  std::uint64_t first = 0;
  std::uint64_t last = curve.times.count();
  while (last - first > 1) {
    const std::uint64_t middle = first + (last - first) / 2;
    (time_at(curve, middle) <= time ? first : last) = middle;
  }
  return first;
}

// `part` of a keyframe with three parts: in-tangent, value, out-tangent.
Values elements_of(const Curve& curve, std::uint64_t keyframe, std::uint64_t part,
                   std::uint64_t width) {
  const std::uint64_t first = (keyframe * values_per_keyframe(curve.interpolation) + part) * width;
  Values values;
  for (std::uint64_t i = 0; i < width; ++i) {
    const Values element = element_at(curve.values, first + i);
    values.insert(values.end(), element.begin(), element.end());
  }
  return values;
}

Values linear(const Values& from, const Values& to, double t) {
  Values values(from.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] =
        static_cast<float>(static_cast<double>(from[i]) * (1 - t) + static_cast<double>(to[i]) * t);
  }
  return values;
}

// The spline of appendix C.5; `span` is the time between the keyframes.
Values cubic(const Curve& curve, std::uint64_t keyframe, std::uint64_t width, double t,
             double span) {
  const Values from = elements_of(curve, keyframe, 1, width);
  const Values out = elements_of(curve, keyframe, 2, width);
  const Values in = elements_of(curve, keyframe + 1, 0, width);
  const Values to = elements_of(curve, keyframe + 1, 1, width);
  const double t2 = t * t;
  const double t3 = t2 * t;
  Values values(from.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<float>((2 * t3 - 3 * t2 + 1) * static_cast<double>(from[i]) +
                                   span * (t3 - 2 * t2 + t) * static_cast<double>(out[i]) +
                                   (3 * t2 - 2 * t3) * static_cast<double>(to[i]) +
                                   span * (t3 - t2) * static_cast<double>(in[i]));
  }
  return values;
}

Quaternion quaternion(const Values& values) {
  Quaternion q{};
  std::copy(values.begin(), values.end(), q.begin());
  return q;
}

Values values_of(const Quaternion& q) {
  Values values;
  for (const double each : q) values.push_back(static_cast<float>(each));
  return values;
}

Values between(const Curve& curve, std::uint64_t keyframe, std::uint64_t width, double time,
               bool rotation) {
  const double begin = time_at(curve, keyframe);
  const double span = time_at(curve, keyframe + 1) - begin;
  const double t = span > 0 ? std::clamp((time - begin) / span, 0.0, 1.0) : 0;
  if (curve.interpolation == Interpolation::cubic_spline) {
    return cubic(curve, keyframe, width, t, span);
  }
  Values from = elements_of(curve, keyframe, 0, width);
  if (curve.interpolation == Interpolation::step) return from;
  const Values to = elements_of(curve, keyframe + 1, 0, width);
  if (rotation) return values_of(slerp(quaternion(from), quaternion(to), t));
  return linear(from, to, t);
}

/// Evaluates the channels of one animation.
class Sampling {
 public:
  Sampling(const Asset& asset, const Views& views, const ResourceData& resources,
           const schema::Set& schemas, double time)
      : asset_(asset),
        views_(views),
        resources_(resources),
        model_(asset, schemas),
        time_(time),
        budget_(kMostBytes) {}

  AnimationSample run(const Animation& animation) {
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
      const std::string_view problem = add(animation, animation.channels[i]);
      if (problem.empty()) continue;
      if (++left_out_ == 1) {
        sample_.notes.push_back(fmt::format("Channel {} of the animation {}.", i, problem));
      }
    }
    if (left_out_ > 1) {
      sample_.notes.push_back(
          fmt::format("{} channels of the animation were left out.", left_out_));
    }
    return std::move(sample_);
  }

  std::vector<ClipChannel> channels(const Animation& animation) {
    std::vector<ClipChannel> opened;
    for (const AnimationChannel& channel : animation.channels) {
      if (!open(animation, channel, opened.emplace_back()).empty()) opened.pop_back();
    }
    return opened;
  }

 private:
  // The target of a channel.
  struct Target {
    std::string pointer;
    std::uint64_t width = 1;
    bool rotation = false;
    unsigned components = 1;
  };

  std::string_view add(const Animation& animation, const AnimationChannel& channel) {
    ClipChannel opened;
    const std::string_view problem = open(animation, channel, opened);
    if (!problem.empty()) return problem;
    if (!budget_.take(checked_mul(opened.width, sizeof(float)))) {
      return "moves more numbers than may be kept";
    }
    std::vector<float> values = value_at(opened.curve, time_, opened.width, opened.rotation);
    if (values.empty()) return "has too few values";
    sample_.values.insert_or_assign(std::move(opened.pointer), std::move(values));
    return {};
  }

  // What is wrong with the channel; empty: nothing.
  std::string_view open(const Animation& animation, const AnimationChannel& channel,
                        ClipChannel& to) {
    auto target = find_target(channel);
    if (!target) return "moves nothing that is drawn";
    if (!channel.sampler) return "has no sampler";
    auto curve = open(animation.samplers[*channel.sampler]);
    if (!curve) return "has keyframes that cannot be read";
    if (curve->values.components() != target->components) return "has values of another type";
    to = {std::move(target->pointer), target->width, target->rotation, *std::move(curve)};
    return {};
  }

  std::optional<Target> find_target(const AnimationChannel& channel) {
    const json::NodeId extension =
        extension_object(asset_.document(), channel.target, kPointerExtension);
    if (extension != json::kNoNode) {
      return find_property(string_member(asset_.document(), extension, "pointer"));
    }
    if (!channel.node) return std::nullopt;
    Target target;
    target.pointer = fmt::format("/nodes/{}/{}", *channel.node, animation_path_name(channel.path));
    target.rotation = channel.path == AnimationPath::rotation;
    target.components = target.rotation ? 4 : 3;
    if (channel.path == AnimationPath::weights) {
      target.components = 1;
      target.width = target_count(*channel.node);
    }
    const bool known = channel.path != AnimationPath::none && channel.path != AnimationPath::other;
    return known && target.width > 0 ? std::optional(target) : std::nullopt;
  }

  std::uint64_t target_count(NodeIndex node) const {
    const auto& mesh = views_.nodes[node].mesh;
    if (!mesh || views_.meshes[*mesh].primitives.empty()) return 0;
    return views_.meshes[*mesh].primitives.front().targets.size();
  }

  static unsigned components_of(PropertyType type) {
    switch (type) {
      case PropertyType::float2:
        return 2;
      case PropertyType::float3:
        return 3;
      case PropertyType::float4:
      case PropertyType::float2x2:
        return 4;
      case PropertyType::float3x3:
        return 9;
      case PropertyType::float4x4:
        return 16;
      default:
        return 1;
    }
  }

  std::optional<Target> find_property(const std::string& pointer) {
    const PropertyTarget found = model_.resolve(pointer);
    if (found.status != PropertyTarget::Status::mutable_property) return std::nullopt;
    Target target;
    target.pointer = found.property;
    if (found.element) target.pointer.append("/").append(std::to_string(*found.element));
    target.components = components_of(found.type);
    if (found.type == PropertyType::number_array && !found.element) target.width = found.length;
    target.rotation = target.pointer.starts_with("/nodes/") &&
                      target.pointer.ends_with("/rotation") && target.components == 4;
    return target;
  }

  std::optional<Curve> open(const AnimationSampler& sampler) const {
    if (!sampler.input || !sampler.output) return std::nullopt;
    if (sampler.interpolation == Interpolation::unknown) return std::nullopt;
    auto times = open(*sampler.input);
    auto values = open(*sampler.output);
    if (!times || !values || times->components() != 1) return std::nullopt;
    return Curve{*std::move(times), *std::move(values), sampler.interpolation};
  }

  std::optional<AccessorData> open(std::uint32_t accessor) const {
    return AccessorData::open(asset_, views_, resources_, views_.accessors[accessor],
                              Malformed::unusable);
  }

  const Asset& asset_;
  const Views& views_;
  const ResourceData& resources_;
  ObjectModel model_;
  double time_;
  MemoryBudget budget_;
  std::uint64_t left_out_ = 0;
  AnimationSample sample_;
};

}  // namespace

std::vector<float> value_at(const Curve& curve, double time, std::uint64_t width, bool rotation) {
  const std::uint64_t keyframes = curve.times.count();
  const Checked per_keyframe = checked_mul(width, values_per_keyframe(curve.interpolation));
  const Checked needed = per_keyframe ? checked_mul(*per_keyframe, keyframes) : std::nullopt;
  const bool spline = curve.interpolation == Interpolation::cubic_spline;
  if (!needed || *needed > curve.values.count() || (spline && keyframes < 2)) return {};
  if (rotation && (curve.values.components() != 4 || width != 1)) return {};
  const std::uint64_t keyframe = keyframe_before(curve, time);
  const bool inside = time > time_at(curve, keyframe) && keyframe + 1 < keyframes;
  std::vector<float> values = inside ? between(curve, keyframe, width, time, rotation)
                                     : elements_of(curve, keyframe, spline ? 1 : 0, width);
  return rotation ? values_of(unit(quaternion(values))) : values;
}

double duration_of(const Asset& asset, const Views& views, const Animation& animation) {
  double last = 0;
  for (const AnimationSampler& sampler : animation.samplers) {
    if (!sampler.input) continue;
    const auto end = float_array<1>(asset.document(), views.accessors[*sampler.input].max);
    if (end) last = std::max(last, static_cast<double>((*end)[0]));
  }
  return last;
}

AnimationSample sample_animation(const Asset& asset, const Views& views,
                                 const ResourceData& resources, const schema::Set& schemas,
                                 std::uint32_t index, double time) {
  return Sampling(asset, views, resources, schemas, time).run(views.animations[index]);
}

std::vector<ClipChannel> open_clip(const Asset& asset, const Views& views,
                                   const ResourceData& resources, const schema::Set& schemas,
                                   std::uint32_t index) {
  return Sampling(asset, views, resources, schemas, 0).channels(views.animations[index]);
}

}  // namespace gltfx::model

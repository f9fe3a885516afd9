// SPDX-License-Identifier: Apache-2.0
// Keyframes between which a property jumps or vanishes.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/elements.hpp"
#include "rules/collector.hpp"
#include "rules/finding.hpp"
#include "rules/shows/curve_scan.hpp"
#include "rules/shows/fix_curves.hpp"
#include "rules/shows/shows.hpp"

namespace gltfx::validate {
namespace {

using model::AnimationPath;
using model::Interpolation;
using Value = std::array<double, 4>;

// One curve of rotations, translations or scales.
struct Keys {
  std::vector<float> times;
  model::Vectors<4> values;  ///< in-tangent, value and out-tangent of each key, or values
  unsigned width = 0;        ///< components that count
  bool cubic = false;

  std::size_t count() const { return times.size(); }
  Value part(std::size_t key, std::size_t which) const {
    const auto& stored = values[cubic ? key * 3 + which : key];
    Value value{};
    for (std::size_t k = 0; k < width; ++k) value[k] = static_cast<double>(stored[k]);
    return value;
  }
  Value value(std::size_t key) const { return part(key, 1); }
  double duration(std::size_t key) const {
    return static_cast<double>(times[key + 1]) - static_cast<double>(times[key]);
  }
};

double inner(const Value& a, const Value& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

// The least length of a spline between two keys (specification appendix C.5).
double least_length(const Keys& keys, std::size_t key) {
  const Value from = keys.value(key);
  const Value to = keys.value(key + 1);
  const Value out = keys.part(key, 2);
  const Value in = keys.part(key + 1, 0);
  const double duration = keys.duration(key);
  constexpr int kSteps = 64;
  double least = 1;
  for (int i = 1; i < kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double a = (1 + 2 * t) * (1 - t) * (1 - t);
    const double b = t * (1 - t) * (1 - t) * duration;
    const double c = t * t * (3 - 2 * t);
    const double d = t * t * (t - 1) * duration;
    Value at{};
    for (std::size_t k = 0; k < 4; ++k) at[k] = a * from[k] + b * out[k] + c * to[k] + d * in[k];
    least = std::min(least, inner(at, at));
  }
  return std::sqrt(least);
}

// What is wrong between two keys, of the first such pair, and their number.
struct Pairs {
  std::size_t first = 0;
  std::uint64_t count = 0;
  double figure = 0;

  void add(std::size_t key, double of) {
    if (count++ == 0) {
      first = key;
      figure = of;
    }
  }
};

// Rotations that turn almost around because a key has the other sign, or pass 0.
Pairs find_flips(const Keys& keys) {
  constexpr double kShortcut = 0.5;  // a turn of 240 degrees between two keys
  constexpr double kVanishing = 0.1;
  Pairs flips;
  for (std::size_t i = 0; keys.cubic && i + 1 < keys.count(); ++i) {
    const double along = inner(keys.value(i), keys.value(i + 1));
    const Value out = keys.part(i, 2);
    const Value in = keys.part(i + 1, 0);
    const double pull = (std::sqrt(inner(out, out)) + std::sqrt(inner(in, in))) * keys.duration(i);
    if (along >= 0 && pull <= 1) continue;  // never shorter than 0.5
    const double least = least_length(keys, i);
    if (least < kVanishing || (along < 0 && least < kShortcut)) flips.add(i, least);
  }
  return flips;
}

// Rotations of half a turn between two keys, which have no shorter way.
Pairs find_half_turns(const Keys& keys, bool linear) {
  constexpr double kHalf = 1e-3;
  constexpr double kPop = 0.1;  // seconds: what is faster than that is meant as a cut
  Pairs turns;
  for (std::size_t i = 0; linear && i + 1 < keys.count(); ++i) {
    const double along = inner(keys.value(i), keys.value(i + 1));
    if (std::abs(along) < kHalf && keys.duration(i) >= kPop) turns.add(i, along);
  }
  return turns;
}

// Scales that change their sign between two keys.
Pairs find_scale_signs(const Keys& keys, bool steps) {
  Pairs signs;
  for (std::size_t i = 0; !steps && i + 1 < keys.count(); ++i) {
    const Value from = keys.value(i);
    const Value to = keys.value(i + 1);
    for (std::size_t k = 0; k < 3; ++k) {
      if (from[k] * to[k] < 0) {
        signs.add(i, to[k]);
        break;
      }
    }
  }
  return signs;
}

// Whether the keys are all the same, but tangents move the curve away from them.
bool has_idle_tangents(const Keys& keys) {
  constexpr double kSame = 1e-6;
  if (!keys.cubic || keys.count() < 2) return false;
  const Value still = keys.value(0);
  double moves = 0;
  for (std::size_t i = 0; i < keys.count(); ++i) {
    const Value value = keys.value(i);
    for (std::size_t k = 0; k < 4; ++k) {
      if (std::abs(value[k] - still[k]) > kSame) return false;
      if (i + 1 < keys.count()) moves = std::max(moves, std::abs(keys.part(i, 2)[k]));
      if (i > 0) moves = std::max(moves, std::abs(keys.part(i, 0)[k]));
    }
  }
  return moves > 1e-4;
}

// Whether linear keys may be half a turn apart, or change a sign.
bool may_matter(const model::AccessorData& values, AnimationPath path) {
  if (values.format().component != model::ComponentType::float32) return true;
  constexpr float kNearHalf = 2e-3F;  // twice what counts: single precision rounds
  const bool rotation = path == AnimationPath::rotation;
  const std::size_t width = rotation ? 4 : 3;
  const auto look = [rotation](const float* vectors, std::size_t count) {
    return rotation ? has_right_angle(vectors, count, kNearHalf) : has_sign_change(vectors, count);
  };
  bool found = false;
  std::array<float, 8> seam{};  // the last key of a block, and the first one of the next
  values.visit<float>([&](const float* numbers, std::size_t elements, std::uint64_t first) {
    std::copy_n(numbers, width, seam.begin() + static_cast<std::ptrdiff_t>(width));
    found |= (first > 0 && look(seam.data(), 2)) || look(numbers, elements);
    std::copy_n(numbers + (elements - 1) * width, width, seam.begin());
  });
  return found;
}

class KeyframeRules {
 public:
  explicit KeyframeRules(DataPhase& phase)
      : phase_(phase),
        context_(phase.context),
        inputs_(context_.views.accessors.size()),
        outputs_(context_.views.accessors.size()) {}

  void run() {
    const auto& animations = context_.views.animations;
    for (std::size_t i = 0; i < animations.size(); ++i) {
      animation_ = i;
      std::vector<std::uint8_t> seen(animations[i].samplers.size());
      for (const model::AnimationChannel& channel : animations[i].channels) {
        if (!channel.sampler || std::exchange(seen[*channel.sampler], 1) != 0) continue;
        check(animations[i].samplers[*channel.sampler], channel);
      }
    }
  }

 private:
  void check(const model::AnimationSampler& sampler, const model::AnimationChannel& channel) {
    if (!sampler.input || !sampler.output) return;
    at_ = *channel.sampler;
    sampler_ = sampler.object;
    if (std::exchange(inputs_[*sampler.input], 1) == 0) check_density(*sampler.input);
    if (!is_interesting(sampler.interpolation, channel.path)) return;
    if (is_known(sampler, channel.path)) return;
    const auto keys = read(sampler, channel.path);
    if (!keys) return;
    if (channel.path == AnimationPath::rotation) check_rotation(*keys, sampler.interpolation);
    if (channel.path == AnimationPath::scale) {
      const Pairs signs = find_scale_signs(*keys, sampler.interpolation == Interpolation::step);
      report(signs, Code::ANIMATION_SCALE_SIGN, [&] {
        return fmt::format(
            "The scale changes its sign between keys {} and {} ({}): what it scales "
            "vanishes on the way, and is mirrored after it",
            signs.first, signs.first + 1, span(*keys, signs.first));
      });
    }
    if (has_idle_tangents(*keys)) {
      send(
          Code::ANIMATION_TANGENTS_MOVE, "output",
          "All keys have the same value, but tangents that are not 0 move the curve between them.");
    }
  }

  // Curves that share accessors are the same.
  bool is_known(const model::AnimationSampler& sampler, AnimationPath path) {
    const Curve curve{*sampler.input, sampler.interpolation, path};
    std::optional<Curve>& first = outputs_[*sampler.output];
    if (first) return curve == *first || !more_.emplace(*sampler.output, curve).second;
    first = curve;
    return false;
  }

  // Steps have no way between keys, and only some properties can vanish on it.
  bool is_interesting(Interpolation interpolation, AnimationPath path) const {
    const bool linear = interpolation == Interpolation::linear;
    const bool cubic = interpolation == Interpolation::cubic_spline;
    if (path == AnimationPath::rotation || path == AnimationPath::scale) return linear || cubic;
    return path == AnimationPath::translation && cubic &&
           is_enabled(context_.options, Code::ANIMATION_TANGENTS_MOVE);
  }

  std::optional<Keys> read(const model::AnimationSampler& sampler, AnimationPath path) {
    const auto values = phase_.open(*sampler.output);
    Keys keys;
    keys.cubic = sampler.interpolation == Interpolation::cubic_spline;
    keys.width = path == AnimationPath::rotation ? 4 : 3;
    if (!values || values->implied() || values->components() != keys.width) return std::nullopt;
    if (!phase_.budget.take(values->count(), keys.width)) return std::nullopt;
    if (!keys.cubic && !may_matter(*values, path)) return std::nullopt;
    const auto times = phase_.open(*sampler.input);
    if (!times || times->implied() || times->components() != 1) return std::nullopt;
    if (values->count() != times->count() * (keys.cubic ? 3 : 1)) return std::nullopt;
    if (!phase_.budget.take(times->count(), 1)) return std::nullopt;
    model::Vectors<1> read(static_cast<std::size_t>(times->count()));
    model::read_elements(*times, read);
    keys.times.reserve(read.size());
    for (const auto& each : read) keys.times.push_back(each[0]);
    keys.values.resize(static_cast<std::size_t>(values->count()));
    model::read_elements(*values, keys.values);
    return keys;
  }

  void check_rotation(const Keys& keys, Interpolation interpolation) {
    const Pairs flips = find_flips(keys);
    report(flips, Code::ANIMATION_ROTATION_FLIPS, [&] {
      const double along = inner(keys.value(flips.first), keys.value(flips.first + 1));
      return fmt::format(
          "The curve from key {} to key {} ({}) {}, and its length falls to {:.2g} of "
          "1: the rotation turns round or jumps there",
          flips.first, flips.first + 1, span(keys, flips.first),
          along < 0 ? "changes to quaternions of the opposite sign"
                    : "is pulled towards 0 by its tangents",
          flips.figure);
    });
    const Pairs turns = find_half_turns(keys, interpolation == Interpolation::linear);
    report(turns, Code::ANIMATION_HALF_TURN, [&] {
      return fmt::format(
          "Keys {} and {} ({}) are half a turn apart: either direction is as short, "
          "and engines choose differently",
          turns.first, turns.first + 1, span(keys, turns.first));
    });
  }

  // More keys than any display has frames.
  void check_density(std::uint32_t input) {
    constexpr std::uint64_t kMany = 200;
    constexpr double kFrame = 1.0 / 240;
    const model::Accessor& accessor = context_.views.accessors[input];
    if (!accessor.count || *accessor.count < kMany) return;
    const auto first = model::float_array<1>(context_.document, accessor.min);
    const auto last = model::float_array<1>(context_.document, accessor.max);
    if (!first || !last) return;
    const double duration = static_cast<double>((*last)[0]) - static_cast<double>((*first)[0]);
    const double each = duration / static_cast<double>(*accessor.count - 1);
    if (!(each < kFrame)) return;
    send(Code::ANIMATION_KEYS_DENSE, "input",
         fmt::format("{} keys in {:.3g} s are {:.0f} a second, more than any display shows.",
                     *accessor.count, duration, 1 / std::max(each, 1e-9)));
  }

  static std::string span(const Keys& keys, std::size_t key) {
    return fmt::format("{:.3g} s to {:.3g} s", keys.times[key], keys.times[key + 1]);
  }

  template <class Sentence>
  void report(const Pairs& pairs, Code code, const Sentence& sentence) {
    if (pairs.count == 0) return;
    std::string message = sentence();
    if (pairs.count > 1)
      message += fmt::format("; this is the first of {} such pairs", pairs.count);
    send(code, "output", message + ".");
  }

  void send(Code code, std::string_view member, std::string message) {
    report_at(
        phase_.sink, fmt::format("/animations/{}/samplers/{}/{}", animation_, at_, member),
        finding_on(context_, context_.document.find(sampler_, member), code, std::move(message)));
  }

  DataPhase& phase_;
  const Context& context_;
  using Curve = std::tuple<std::uint32_t, Interpolation, AnimationPath>;  // times, meaning
  std::vector<std::uint8_t> inputs_;           ///< whether checked, by accessor
  std::vector<std::optional<Curve>> outputs_;  ///< the first curve with these values, by accessor
  std::set<std::pair<std::uint32_t, Curve>> more_;
  std::size_t animation_ = 0;             ///< the sampler that is checked
  std::uint32_t at_ = 0;                  ///< likewise
  json::NodeId sampler_ = json::kNoNode;  ///< likewise
};

}  // namespace

void check_keyframes(DataPhase& phase) { KeyframeRules(phase).run(); }

const RuleGroup& keyframe_fix_rules() {
  static constexpr FixEntry kFixes[] = {{Code::ANIMATION_ROTATION_FLIPS, negate_keys},
                                        {Code::ANIMATION_TANGENTS_MOVE, clear_tangents}};
  static constexpr RuleGroup group{.fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// Keyframes that interpolation reproduces.
#include "model/keyframes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/checked.hpp"
#include "measure/take.hpp"
#include "model/elements.hpp"
#include "model/keyframe_choice.hpp"
#include "model/memory_budget.hpp"

namespace gltfx::measure {
namespace {

using model::CurveKind;
using model::Interpolation;

// The samplers of an animation that have the same times.
struct CurveGroup {
  std::vector<const model::AnimationSampler*> samplers;
  std::vector<bool> rotations;  // as samplers
};

// Why keyframes cannot be counted.
enum class Obstacle : std::uint8_t { none, unread, too_much };

class RedundantKeyframes {
 public:
  explicit RedundantKeyframes(const Source& source) : source_(source) {}

  // The number of keyframes that may go.
  std::uint64_t count(const model::Animation& animation, Obstacle& obstacle) {
    std::uint64_t redundant = 0;
    for (const auto& [input, group] : groups_of(animation)) {
      redundant += count(input, group, obstacle);
      if (obstacle != Obstacle::none) return 0;
    }
    return redundant;
  }

 private:
  static std::map<std::uint32_t, CurveGroup> groups_of(const model::Animation& animation) {
    std::vector<bool> rotates(animation.samplers.size());
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.sampler && channel.path == model::AnimationPath::rotation) {
        rotates[*channel.sampler] = true;
      }
    }
    std::map<std::uint32_t, CurveGroup> groups;
    for (std::size_t i = 0; i < animation.samplers.size(); ++i) {
      const model::AnimationSampler& sampler = animation.samplers[i];
      if (!sampler.input) continue;
      CurveGroup& group = groups[*sampler.input];
      group.samplers.push_back(&sampler);
      group.rotations.push_back(rotates[i]);
    }
    return groups;
  }

  std::optional<std::vector<float>> numbers(std::uint32_t accessor, Obstacle& obstacle) {
    const auto data =
        model::AccessorData::open(source_.asset(), source_.views(), source_.resources(),
                                  source_.views().accessors[accessor], model::Malformed::unusable);
    if (!data) {
      obstacle = Obstacle::unread;
      return std::nullopt;
    }
    if (!budget_.take(checked_mul(data->count(), sizeof(float) * data->components()))) {
      obstacle = Obstacle::too_much;
      return std::nullopt;
    }
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(data->count()) * data->components());
    bool finite = true;
    model::for_each_component(*data, static_cast<std::size_t>(data->count()),
                              [&](std::size_t, unsigned, float value) {
                                values.push_back(value);
                                finite = finite && std::isfinite(value);
                              });
    if (!finite) obstacle = Obstacle::unread;
    return values;
  }

  std::uint64_t count(std::uint32_t input, const CurveGroup& group, Obstacle& obstacle) {
    // The tangents of a spline stand at each keyframe.
    const bool spline = std::any_of(
        group.samplers.begin(), group.samplers.end(),
        [](const auto* sampler) { return sampler->interpolation == Interpolation::cubic_spline; });
    if (spline) return 0;
    const auto times = numbers(input, obstacle);
    if (!times || obstacle != Obstacle::none || times->size() < 3) return 0;
    std::vector<model::KeyedCurve> curves;
    for (std::size_t i = 0; i < group.samplers.size(); ++i) {
      const auto& output = group.samplers[i]->output;
      auto values = output ? numbers(*output, obstacle) : std::nullopt;
      const bool fits = values && !values->empty() && values->size() % times->size() == 0 &&
                        (!group.rotations[i] || values->size() == 4 * times->size());
      const bool known = group.samplers[i]->interpolation != Interpolation::unknown;
      if (obstacle == Obstacle::none && (!fits || !known)) obstacle = Obstacle::unread;
      if (obstacle != Obstacle::none) return 0;
      curves.push_back(
          curve_of(*group.samplers[i], group.rotations[i], times->size(), *std::move(values)));
    }
    if (std::adjacent_find(times->begin(), times->end(), std::greater_equal<>()) != times->end()) {
      obstacle = Obstacle::unread;
      return 0;
    }
    return times->size() - model::choose_keyframes(*times, curves).size();
  }

  static model::KeyedCurve curve_of(const model::AnimationSampler& sampler, bool rotation,
                                    std::size_t keys, std::vector<float> values) {
    model::KeyedCurve curve;
    curve.width = values.size() / keys;
    curve.values = std::move(values);
    curve.kind = rotation ? CurveKind::rotation : CurveKind::linear;
    if (sampler.interpolation == Interpolation::step) curve.kind = CurveKind::step;
    return curve;
  }

  const Source& source_;
  model::MemoryBudget budget_{std::uint64_t{1} << 32U};
};

}  // namespace

void take_keyframes(Taking& taking) {
  Column* column = taking.column(MeasureScope::animation, Name::redundant_keyframes);
  if (column == nullptr) return;
  RedundantKeyframes keyframes(taking.source());
  const auto& animations = taking.source().views().animations;
  for (std::size_t i = 0; i < animations.size(); ++i) {
    if (animations[i].object == json::kNoNode) continue;
    Obstacle obstacle = Obstacle::none;
    const std::uint64_t count = keyframes.count(animations[i], obstacle);
    if (obstacle == Obstacle::unread) {
      column->could_not_be_taken(i, "The keyframes could not be read.");
    } else if (obstacle == Obstacle::too_much) {
      column->could_not_be_taken(i, "Animations share too many bytes.");
    } else {
      column->set(i, count);
    }
  }
}

}  // namespace gltfx::measure

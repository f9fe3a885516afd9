// SPDX-License-Identifier: Apache-2.0
// Removes keyframes that interpolation of the others reproduces (glTF 2.0 section 3.11).
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "model/elements.hpp"
#include "model/keyframe_choice.hpp"
#include "steps/step_data.hpp"
#include "steps/storage.hpp"

namespace gltfx::steps {
namespace {

using model::AnimationPath;
using model::AnimationSampler;
using model::Interpolation;

/// A sampler and the kinds of properties that its channels animate.
struct UsedSampler {
  const AnimationSampler* sampler = nullptr;
  bool rotations = false;
  bool others = false;
  bool unknown = false;  ///< a property of an extension, or none
};

/// The samplers that use an accessor for their values.
struct ValueUses {
  std::uint64_t count = 0;
  std::optional<std::uint32_t> input;  ///< accessor of their times
  bool apart = false;                  ///< their times differ

  void note(const std::optional<std::uint32_t>& other) {
    apart |= !other || (count > 0 && other != input);
    input = other;
    ++count;
  }
};

/// All samplers with the same times.
struct Clip {
  std::uint32_t input = 0;
  std::vector<UsedSampler> samplers;
  std::string obstacle;  ///< empty: there is none
};

/// The stored values of a sampler.
struct Output {
  std::uint32_t accessor = 0;
  std::size_t key_size = 0;  ///< bytes per keyframe
  std::string bytes;         ///< packed
};

double tolerance_of(const ConvertOptions& options) {
  return options.quantize ? options.quantize->animation.value_or(0) : 0;
}

class Resampler {
 public:
  explicit Resampler(const StepInput& input)
      : data_(input),
        changes_(data_),
        tolerance_(tolerance_of(input.options)),
        uses_(data_.views.accessors.size()) {}

  Result<StepOutcome> run() {
    find_clips();
    for (const Clip& clip : clips_) {
      std::string why = clip.obstacle.empty() ? resample(clip) : clip.obstacle;
      if (why.empty()) continue;
      outcome_.row.left.push_back(
          {data_.pointer(clip.samplers.front().sampler->object), std::move(why)});
    }
    if (removed_ == 0) return std::move(outcome_);
    if (std::string why = find_doubt(data_.graph, "accessors"); !why.empty()) {
      outcome_.row.refused.push_back({{}, std::move(why)});
      return std::move(outcome_);
    }
    auto change = changes_.finish();
    if (!change) return change.error();
    outcome_.change = *std::move(change);
    outcome_.freedom.keyframes = true;
    if (tolerance_ > 0) outcome_.freedom.loss = data_.input.options.quantize;
    outcome_.row.what = fmt::format("{} of {} keyframes removed", removed_, keyframes_);
    return std::move(outcome_);
  }

 private:
  void find_clips() {
    std::map<std::uint32_t, std::size_t> numbers;
    for (const model::Animation& animation : data_.views.animations) {
      for (UsedSampler& used : samplers_of(animation)) {
        const auto& input = used.sampler->input;
        if (used.sampler->output) uses_[*used.sampler->output].note(input);
        if (!input) {
          clips_.push_back({0, {used}, "has members that cannot be read"});
          continue;
        }
        const auto [place, is_new] = numbers.try_emplace(*input, clips_.size());
        if (is_new) clips_.push_back({*input, {}, {}});
        clips_[place->second].samplers.push_back(used);
      }
    }
    for (Clip& clip : clips_) {
      if (clip.obstacle.empty()) clip.obstacle = obstacle_of(clip);
    }
  }

  std::vector<UsedSampler> samplers_of(const model::Animation& animation) const {
    std::vector<UsedSampler> samplers;
    for (const AnimationSampler& sampler : animation.samplers)
      samplers.push_back({&sampler, false, false, false});
    for (const model::AnimationChannel& channel : animation.channels) {
      if (!channel.sampler) continue;
      UsedSampler& used = samplers[*channel.sampler];
      const bool by_extension = channel.target == json::kNoNode ||
                                data_.document.find(channel.target, "extensions") != json::kNoNode;
      if (by_extension || channel.path == AnimationPath::none ||
          channel.path == AnimationPath::other) {
        used.unknown = true;
      } else {
        (channel.path == AnimationPath::rotation ? used.rotations : used.others) = true;
      }
    }
    return samplers;
  }

  std::string obstacle_of(const Clip& clip) const {
    if (data_.graph.users(accessor(clip.input).node).size() != clip.samplers.size())
      return "shares its times with objects other than samplers";
    for (const UsedSampler& used : clip.samplers) {
      if (!used.sampler->output || used.sampler->interpolation == Interpolation::unknown)
        return "has members that cannot be read";
      if (used.sampler->interpolation == Interpolation::cubic_spline)
        return "shares its times with CUBICSPLINE, which does not change";
      if (used.unknown) return "animates a property that an extension defines";
      if (!used.rotations && !used.others) return "has no channel";
      if (used.rotations && used.others) return "animates both rotations and other properties";
      const ValueUses& uses = uses_[*used.sampler->output];
      const auto users = data_.graph.users(accessor(*used.sampler->output).node).size();
      if (uses.apart || users != uses.count) return "shares its values with other objects";
    }
    return {};
  }

  const model::Accessor& accessor(std::uint32_t index) const {
    return data_.views.accessors[index];
  }

  // Why a clip is left; empty: it is not.
  std::string resample(const Clip& clip) {
    std::optional<model::AccessorData> data;
    if (std::string why = data_.open(clip.input, data); !why.empty()) return why;
    if (data->format() !=
        model::Format{model::ElementType::scalar, model::ComponentType::float32, false})
      return "has times that are not single-precision numbers";
    const std::vector<float> times = numbers_of(*data);
    if (!increase(times)) return "has times that do not increase";
    if (times.size() < 3) return {};
    std::vector<model::KeyedCurve> curves;
    std::vector<Output> outputs;
    for (const UsedSampler& used : clip.samplers) {
      if (std::string why = open(used, times.size(), curves, outputs); !why.empty()) return why;
    }
    const std::vector<std::uint32_t> kept = model::choose_keyframes(times, curves);
    keyframes_ += times.size();
    if (kept.size() == times.size()) return {};
    removed_ += times.size() - kept.size();
    store({clip.input, sizeof(float), packed_bytes(*data)}, kept, false);
    for (const Output& output : outputs) store(output, kept, true);
    return {};
  }

  static bool increase(const std::vector<float>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1])) return false;
    }
    return true;
  }

  static std::vector<float> numbers_of(const model::AccessorData& data) {
    std::vector<float> numbers;
    numbers.reserve(static_cast<std::size_t>(data.count()) * data.components());
    model::for_each_component(
        data, static_cast<std::size_t>(data.count()),
        [&](std::size_t, unsigned, float value) { numbers.push_back(value); });
    return numbers;
  }

  std::string open(const UsedSampler& used, std::size_t keys,
                   std::vector<model::KeyedCurve>& curves, std::vector<Output>& outputs) const {
    std::optional<model::AccessorData> data;
    if (std::string why = data_.open(*used.sampler->output, data); !why.empty()) return why;
    if (data->count() == 0 || data->count() % keys != 0)
      return "has a number of values that does not match its times";
    if (used.rotations && (data->components() != 4 || data->count() != keys))
      return "has rotations that are not quaternions";
    if (!data_.budget.take(checked_mul(data->count(), sizeof(float) * data->components())))
      return "shares its bytes with too many other objects";
    model::KeyedCurve curve;
    curve.values = numbers_of(*data);
    curve.width = curve.values.size() / keys;
    curve.kind = used.rotations ? model::CurveKind::rotation : model::CurveKind::linear;
    if (used.sampler->interpolation == Interpolation::step) curve.kind = model::CurveKind::step;
    curve.tolerance = tolerance_ * (used.rotations ? 1 : greatest_of(curve.values));
    const bool finite = std::all_of(curve.values.begin(), curve.values.end(),
                                    [](float value) { return std::isfinite(value); });
    if (!finite) return "has values that are not finite";
    curves.push_back(std::move(curve));
    std::string bytes = packed_bytes(*data);
    outputs.push_back({*used.sampler->output, bytes.size() / keys, std::move(bytes)});
    return {};
  }

  static double greatest_of(const std::vector<float>& values) {
    double greatest = 0;
    for (const float value : values)
      greatest = std::max(greatest, std::abs(static_cast<double>(value)));
    return greatest;
  }

  void store(const Output& output, const std::vector<std::uint32_t>& kept, bool other_values) {
    std::string bytes;
    bytes.reserve(output.key_size * kept.size());
    for (const std::uint32_t key : kept)
      bytes.append(output.bytes, key * output.key_size, output.key_size);
    const std::uint64_t size = model::packed_stride(accessor(output.accessor).format);
    changes_.contents.set(output.accessor,
                          {std::move(bytes), output.key_size * kept.size() / size, other_values});
  }

  const StepData data_;
  StepChanges changes_;
  const double tolerance_;       ///< as a part of the greatest absolute component of a curve
  std::vector<ValueUses> uses_;  ///< by accessor
  std::vector<Clip> clips_;
  StepOutcome outcome_;
  std::uint64_t removed_ = 0;
  std::uint64_t keyframes_ = 0;
};

}  // namespace

StepDescription resample_step();
StepDescription resample_step() {
  return {"resample",
          "removes keyframes that interpolation of the others reproduces",
          "the curves, the first and the last keyframe, and the length of clips",
          "nothing beyond rounding, one unit in the last place, or the bound of animations",
          [](const ConvertOptions& options) {
            return options.resample || options.shrink || tolerance_of(options) > 0;
          },
          [](const StepInput& input) { return Resampler(input).run(); },
          {},
          [](const ConvertOptions& options) { return tolerance_of(options) > 0; }};
}

}  // namespace gltfx::steps

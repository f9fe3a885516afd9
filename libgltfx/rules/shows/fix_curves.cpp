// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/fix_curves.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "model/animation.hpp"
#include "rules/core/fix_elements.hpp"

namespace gltfx::validate {
namespace {

using model::AnimationPath;

// In-tangent, value, out-tangent.
constexpr std::uint64_t kSplineParts = 3;

struct Spline {
  std::uint32_t accessor = 0;
  Elements elements;
  std::uint64_t keys() const { return elements.count() / kSplineParts; }
};

// Whether all curves with these values are splines of a node's transform, or of its rotation alone.
bool are_splines(const model::Views& views, std::uint32_t accessor, bool rotations) {
  for (const model::Animation& animation : views.animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (!channel.sampler) return false;
      const model::AnimationSampler& sampler = animation.samplers[*channel.sampler];
      if (sampler.output != accessor) continue;
      const bool fits = rotations ? channel.path == AnimationPath::rotation
                                  : channel.path == AnimationPath::rotation ||
                                        channel.path == AnimationPath::translation ||
                                        channel.path == AnimationPath::scale;
      if (!fits || sampler.interpolation != model::Interpolation::cubic_spline) return false;
    }
  }
  return true;
}

std::optional<Spline> open_spline(Fixing& fixing, const Subject& subject, bool rotations) {
  const auto accessor = fixing.index(model::RootArray::accessors, subject.value);
  if (!accessor || !are_splines(fixing.views(), *accessor, rotations)) return std::nullopt;
  auto elements = open_elements(fixing, *accessor, "output");
  const bool fits = elements && elements->is_float() && elements->count() % kSplineParts == 0 &&
                    (!rotations || elements->components() == 4);
  if (!fits) return std::nullopt;
  if (!fixing.table<ReadBudget>().take(elements->count(), elements->components())) {
    return std::nullopt;
  }
  return Spline{*accessor, *std::move(elements)};
}

// The dot product of a key and the one before it.
double along(const Elements& elements, std::uint64_t key) {
  double sum = 0;
  for (unsigned k = 0; k < elements.components(); ++k) {
    sum += elements.get(key * kSplineParts + 1, k) * elements.get((key - 1) * kSplineParts + 1, k);
  }
  return sum;
}

}  // namespace

bool negate_keys(Fixing& fixing, const Subject& subject) {
  constexpr double kTurn = 1e-6;  // a whole turn, or none at all
  auto spline = open_spline(fixing, subject, true);
  if (!spline) return false;
  std::vector<std::uint64_t> negated;
  bool other = false;  // whether the key before is negated
  for (std::uint64_t key = 1; key < spline->keys(); ++key) {
    const double own = along(spline->elements, key);
    if (own < -1 + kTurn) return false;
    if (own < 0) other = !other;
    if (other) negated.push_back(key);
  }
  if (negated.empty()) return false;
  for (const std::uint64_t key : negated) {
    for (std::uint64_t i = key * kSplineParts; i < (key + 1) * kSplineParts; ++i) {
      for (unsigned k = 0; k < spline->elements.components(); ++k) {
        spline->elements.set(i, k, -spline->elements.get(i, k));
      }
    }
  }
  follow_with_bounds(fixing, spline->accessor, spline->elements);
  return true;
}

bool clear_tangents(Fixing& fixing, const Subject& subject) {
  auto spline = open_spline(fixing, subject, false);
  if (!spline) return false;
  for (std::uint64_t i = 0; i < spline->elements.count(); ++i) {
    if (i % kSplineParts == 1) continue;
    for (unsigned k = 0; k < spline->elements.components(); ++k) spline->elements.set(i, k, 0);
  }
  follow_with_bounds(fixing, spline->accessor, spline->elements);
  return true;
}

}  // namespace gltfx::validate

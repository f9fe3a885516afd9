// SPDX-License-Identifier: Apache-2.0
#include "validate/data/slack.hpp"

#include <algorithm>
#include <cmath>

#include "validate/data/extension_checks.hpp"

namespace gltfx::validate {
namespace {

// What a declared bound may be beside data that went through a filter. Integers are computed and
// rounded by decoders, one up and another down. Floats are rounded by encoders to the bits that
// they are asked for, most often after the bounds were taken.
double bound_slack(const Check& check, model::ComponentType type) {
  constexpr double kRounding = 1.0 / 1024;
  if (model::is_integer(type)) return 1;
  double greatest = 0;
  for (const double bound : check.bounds) greatest = std::max(greatest, std::abs(bound));
  return greatest * kRounding;
}

// The widest extent of a component by its declared bounds; 0 when one of them is missing.
double declared_extent(const Schedule& schedule) {
  const auto bounds = [&](CheckKind kind) {
    const auto at = std::find_if(schedule.checks.begin(), schedule.checks.end(),
                                 [&](const Check& check) { return check.kind == kind; });
    return at == schedule.checks.end() ? std::vector<double>() : at->bounds;
  };
  const std::vector<double> least = bounds(CheckKind::minimum);
  const std::vector<double> most = bounds(CheckKind::maximum);
  double extent = 0;
  for (std::size_t i = 0; i < std::min(least.size(), most.size()); ++i) {
    extent = std::max(extent, most[i] - least[i]);
  }
  return extent;
}

}  // namespace

const model::DecodedView* decoded_view(const DataPhase& phase, const Schedule& schedule) {
  const model::Accessor& accessor = phase.context.views.accessors[schedule.accessor];
  const model::BufferView* view = phase.context.views.view_of(accessor);
  return view == nullptr ? nullptr : phase.resources.decoded(*view);
}

void allow_rounding(const DataPhase& phase, Schedule& schedule) {
  const model::DecodedView* decoded = decoded_view(phase, schedule);
  if (decoded == nullptr || !decoded->rounded) return;
  const model::Format& format = phase.context.views.accessors[schedule.accessor].format;
  for (Check& check : schedule.checks) {
    check.bound_slack = bound_slack(check, format.component);
    check.length_slack += length_of_steps(format.component, model::component_count(format.type));
  }
}

void allow_quantization(Schedule& schedule, const std::optional<double>& step) {
  if (!step) return;
  constexpr double kRounding = 1.01;
  constexpr double kTwoOfEightBits = 2.0 / 255;
  const double widening = *step != 0 ? 0 : declared_extent(schedule) * kTwoOfEightBits;
  for (Check& check : schedule.checks) {
    check.bound_slack = std::max(check.bound_slack, *step * kRounding);
    check.bound_widening = widening;
    check.length_slack += *step * kRounding;
  }
}

}  // namespace gltfx::validate

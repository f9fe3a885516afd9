// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/parallel.hpp"
#include "rules/finding.hpp"
#include "rules/payload/describe.hpp"
#include "rules/payload/element_check.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

// The allowed difference between a declared bound and filtered data. Integers are computed and
// rounded by decoders, up or down. Floats are rounded by encoders to a given number of bits,
// usually after the bounds were computed.
double bound_slack(const Check& check, model::ComponentType type) {
  constexpr double kRounding = 1.0 / 1024;
  if (model::is_integer(type)) return 1;
  double greatest = 0;
  for (const double bound : check.bounds) greatest = std::max(greatest, std::abs(bound));
  return greatest * kRounding;
}

// The largest extent of a component by its declared bounds; 0 if one of them is missing.
double declared_extent(const Schedule& schedule) {
  const auto bounds = [&](CheckKind kind) -> std::span<const double> {
    const auto at = std::find_if(schedule.checks.begin(), schedule.checks.end(),
                                 [&](const Check& check) { return check.kind == kind; });
    if (at == schedule.checks.end()) return {};
    return at->bounds;
  };
  const std::span<const double> least = bounds(CheckKind::minimum);
  const std::span<const double> most = bounds(CheckKind::maximum);
  double extent = 0;
  for (std::size_t i = 0; i < std::min(least.size(), most.size()); ++i) {
    extent = std::max(extent, most[i] - least[i]);
  }
  return extent;
}

// The decoded view of an accessor, or null.
const model::DecodedView* decoded_view(const DataPhase& phase, const Schedule& schedule) {
  const model::Accessor& accessor = phase.context.views.accessors[schedule.accessor];
  const model::BufferView* view = phase.context.views.view_of(accessor);
  return view == nullptr ? nullptr : phase.resources.decoded(*view);
}

// Sets the slack of checks of accessors whose view has a filter that rounds.
void allow_rounding(const DataPhase& phase, Schedule& schedule) {
  const model::DecodedView* decoded = decoded_view(phase, schedule);
  if (decoded == nullptr || !decoded->rounded) return;
  const model::Format& format = phase.context.views.accessors[schedule.accessor].format;
  for (Check& check : schedule.checks) {
    check.bound_slack = bound_slack(check, format.component);
    check.length_slack += length_of_steps(format.component, model::component_count(format.type));
  }
}

// Likewise for values that were quantized in steps of `step`: they are at most one step away from
// the originals, plus the error of single precision. Encoders widen bounds by a whole step, and
// some by one of eight bits if they keep the values (`step` 0).
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

using model::AccessorData;

class ElementReport {
 public:
  ElementReport(DataPhase& phase, const Schedule& schedule, const AccessorData& data)
      : phase_(phase),
        data_(data),
        looked_{phase.context, schedule, data.components(), data.count(),
                decoded_view(phase, schedule) == nullptr ? model::ComponentType::none
                                                         : data.format().component} {
    if (!data.step()) return;
    looked_.draco = true;
    looked_.lossy = *data.step() != 0 ||
                    std::any_of(schedule.checks.begin(), schedule.checks.end(),
                                [](const Check& each) { return each.kind == CheckKind::index; });
  }

  void report(const std::vector<Outcome>& outcomes) const {
    const Deviations& deviations = phase_.context.deviations;
    if (deviations.each_finding_is_listed) {
      report_each(outcomes);
    } else {
      report_counts(outcomes);
    }
    const std::vector<Check>& checks = looked_.schedule.checks;
    const bool sound = deviations.consequences_are_reported || !has_invalid_floats(outcomes);
    for (std::size_t i = 0; i < checks.size(); ++i) {
      if (sound) report_bounds(checks[i], outcomes[i]);
      if (outcomes[i].degenerate == 0) continue;
      send(checks[i], describe_degenerate(looked_, checks[i], outcomes[i].degenerate));
    }
  }

 private:
  void send(const Check& check, Finding finding) const {
    with_path(check.place, [&](const Path& path) { phase_.sink.report(path, std::move(finding)); });
  }

  // Without an order there are no bounds.
  static bool has_invalid_floats(const std::vector<Outcome>& outcomes) {
    constexpr auto kKind = static_cast<std::size_t>(ErrorKind::invalid_float);
    return !outcomes.empty() && outcomes.front().errors[kKind].count != 0;
  }

  void report_counts(const std::vector<Outcome>& outcomes) const {
    const std::vector<Check>& checks = looked_.schedule.checks;
    for (std::size_t i = 0; i < checks.size(); ++i) {
      for (const Tally& tally : outcomes[i].errors) {
        if (tally.count == 0) continue;
        send(checks[i], describe(looked_, checks[i], tally.first, tally.count));
      }
    }
  }

  void report_each(const std::vector<Outcome>& outcomes) const {
    std::uint64_t total = 0;
    for (const Outcome& outcome : outcomes) total += outcome.total();
    if (total == 0) return;
    if (!phase_.budget.list(total)) return report_counts(outcomes);
    list_errors(data_, looked_.schedule.checks, [&](const Check& check, const DataError& error) {
      send(check, describe(looked_, check, error, 1));
    });
  }

  void report_bounds(const Check& check, const Outcome& outcome) const {
    for (const BoundError& error : outcome.bounds) {
      with_path(check.place, [&](const Path& accessor) {
        const Path array(accessor, check.kind == CheckKind::minimum ? "min" : "max");
        const Path element(array, std::uint64_t{error.component});
        phase_.sink.report(element, describe_mismatch(looked_, check, error));
        if (error.outside == 0) return;
        phase_.sink.report(element, describe_outside(looked_, check, error));
      });
    }
  }

  DataPhase& phase_;
  const AccessorData& data_;
  ScanResult looked_;
};

std::size_t distinct(const std::vector<Check>& checks) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < checks.size(); ++i) count += checks[i].same_as == i ? 1U : 0U;
  return count;
}

void report_unchecked(DataPhase& phase, std::uint32_t index) {
  const model::Accessor& accessor = phase.context.views.accessors[index];
  report_element(phase.sink, phase.context, model::RootArray::accessors, index,
                 Code::ACCESSOR_DATA_NOT_CHECKED,
                 fmt::format("The accessor has {} elements, far more than the size of the file "
                             "allows; they are not checked.",
                             *accessor.count));
}

// Accessors that one thread reads, one after the other.
struct Batch {
  std::vector<const Schedule*> schedules;
  std::vector<bool> affordable;
  std::uint64_t numbers = 0;
};

// An accessor invalid.
struct Scan {
  std::size_t position;  // position in its batch
  AccessorData data;
  std::vector<Outcome> outcomes;
};

// The accessors that can be read, within the budget, in batches large enough for a thread.
std::vector<Batch> plan_batches(DataPhase& phase, std::vector<Schedule>& schedules) {
  constexpr std::uint64_t kWorthAThread = 1U << 20U;
  std::vector<Batch> batches;
  for (Schedule& schedule : schedules) {
    const auto data = phase.open(schedule.accessor);
    if (!data) continue;
    allow_quantization(schedule, data->step());
    if (batches.empty() || batches.back().numbers >= kWorthAThread) batches.emplace_back();
    Batch& batch = batches.back();
    const std::uint64_t each = data->components() * distinct(schedule.checks);
    const bool affordable = phase.budget.take(data->count(), each);
    batch.schedules.push_back(&schedule);
    batch.affordable.push_back(affordable);
    if (affordable) batch.numbers += data->count() * each;
  }
  return batches;
}

std::vector<Scan> scan_batch(const DataPhase& phase, const Batch& batch) {
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < batch.schedules.size(); ++i) {
    if (!batch.affordable[i]) continue;
    const auto data = phase.open(batch.schedules[i]->accessor);
    if (!data) continue;
    std::vector<Outcome> outcomes = scan(*data, batch.schedules[i]->checks);
    const bool clean = std::all_of(outcomes.begin(), outcomes.end(),
                                   [](const Outcome& each) { return each.clean(); });
    if (!clean) scans.push_back({i, *data, std::move(outcomes)});
  }
  return scans;
}

void report_batch(DataPhase& phase, const Batch& batch, const std::vector<Scan>& scans) {
  auto next = scans.begin();
  for (std::size_t i = 0; i < batch.schedules.size(); ++i) {
    if (!batch.affordable[i]) {
      report_unchecked(phase, batch.schedules[i]->accessor);
    } else if (next != scans.end() && next->position == i) {
      ElementReport(phase, *batch.schedules[i], next->data).report(next->outcomes);
      ++next;
    }
  }
}

}  // namespace

void check_elements(DataPhase& phase) {
  std::vector<Schedule> schedules = schedule_checks(phase.context);
  for (Schedule& schedule : schedules) allow_rounding(phase, schedule);
  const std::vector<Batch> batches = plan_batches(phase, schedules);
  std::vector<std::vector<Scan>> scans(batches.size());
  parallel_ordered(
      batches.size(), phase.context.options.jobs,
      [&](std::size_t i) { scans[i] = scan_batch(phase, batches[i]); },
      [&](std::size_t i) {
        report_batch(phase, batches[i], scans[i]);
        scans[i] = {};
      });
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include <fmt/format.h>

#include "validate/data/describe.hpp"
#include "validate/data/phases.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

class ElementReport {
 public:
  ElementReport(DataPhase& phase, const Schedule& schedule, const model::AccessorData& data)
      : phase_(phase),
        data_(data),
        looked_{phase.context, schedule, data.components(), data.count()} {}

  void report(const std::vector<Outcome>& outcomes) const {
    if (phase_.context.khronos()) {
      report_each(outcomes);
    } else {
      report_counts(outcomes);
    }
    const std::vector<Check>& checks = looked_.schedule.checks;
    const bool sound = phase_.context.khronos() || !has_invalid_floats(outcomes);
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

  // What has no order has no bounds either.
  static bool has_invalid_floats(const std::vector<Outcome>& outcomes) {
    constexpr auto kKind = static_cast<std::size_t>(FaultKind::invalid_float);
    return !outcomes.empty() && outcomes.front().faults[kKind].count != 0;
  }

  void report_counts(const std::vector<Outcome>& outcomes) const {
    const std::vector<Check>& checks = looked_.schedule.checks;
    for (std::size_t i = 0; i < checks.size(); ++i) {
      for (const Tally& tally : outcomes[i].faults) {
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
    list_faults(data_, looked_.schedule.checks, [&](const Check& check, const Fault& fault) {
      send(check, describe(looked_, check, fault, 1));
    });
  }

  void report_bounds(const Check& check, const Outcome& outcome) const {
    for (const BoundFault& fault : outcome.bounds) {
      with_path(check.place, [&](const Path& accessor) {
        const Path array(accessor, check.kind == CheckKind::minimum ? "min" : "max");
        const Path element(array, std::uint64_t{fault.component});
        phase_.sink.report(element, describe_mismatch(looked_, check, fault));
        if (fault.outside == 0) return;
        phase_.sink.report(element, describe_outside(looked_, check, fault));
      });
    }
  }

  DataPhase& phase_;
  const model::AccessorData& data_;
  Looked looked_;
};

std::size_t distinct(const std::vector<Check>& checks) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < checks.size(); ++i) count += checks[i].same_as == i ? 1U : 0U;
  return count;
}

void report_unchecked(DataPhase& phase, std::uint32_t index) {
  const model::Accessor& accessor = phase.context.views.accessors[index];
  const Path root;
  const Path array(root, "accessors");
  phase.sink.report(
      Path(array, std::uint64_t{index}),
      finding_on(phase.context, accessor.node, "ACCESSOR_DATA_NOT_CHECKED",
                 fmt::format("The accessor has {} elements, far more than the file has bytes for; "
                             "they were not looked at.",
                             *accessor.count)));
}

}  // namespace

void check_elements(DataPhase& phase) {
  for (const Schedule& schedule : schedule_checks(phase.context)) {
    const auto data = phase.open(schedule.accessor);
    if (!data) continue;
    if (!phase.budget.take(data->count(), data->components() * distinct(schedule.checks))) {
      report_unchecked(phase, schedule.accessor);
      continue;
    }
    ElementReport(phase, schedule, *data).report(scan(*data, schedule.checks));
  }
}

}  // namespace gltfx::validate

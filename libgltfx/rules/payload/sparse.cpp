// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/finding.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {
namespace {

struct SparseError {
  std::uint64_t position = 0;
  std::uint64_t index = 0;
  std::uint64_t other = 0;  ///< the previous index, or the number of elements
};

class SparseReport {
 public:
  SparseReport(DataPhase& phase, std::uint32_t accessor) : phase_(phase), accessor_(accessor) {}

  void note(bool order, const SparseError& error) {
    Tally& tally = order ? order_ : range_;
    if (phase_.context.deviations.each_finding_is_listed && phase_.budget.list(1)) {
      return send(order, error, 1);
    }
    if (tally.count++ == 0) tally.first = error;
  }

  void finish() const {
    if (order_.count != 0) send(true, order_.first, order_.count);
    if (range_.count != 0) send(false, range_.first, range_.count);
  }

 private:
  struct Tally {
    std::uint64_t count = 0;
    SparseError first;
  };

  void send(bool order, const SparseError& error, std::uint64_t count) const {
    std::string message =
        order ? fmt::format("Sparse index {} is {}; it must be greater than the previous one, {}.",
                            error.position, error.index, error.other)
              : fmt::format("Sparse index {} is {}, but the accessor has {} elements.",
                            error.position, error.index, error.other);
    if (count > 1) message += fmt::format(" This is the first of {}.", count);
    const json::NodeId sparse = phase_.context.views.accessors[accessor_].sparse;
    Finding finding = finding_on(
        phase_.context, sparse,
        order ? Code::ACCESSOR_SPARSE_INDICES_NON_INCREASING : Code::ACCESSOR_SPARSE_INDEX_OOB,
        std::move(message));
    finding.count = count;
    const Path root;
    const Path array(root, "accessors");
    const Path accessor(array, std::uint64_t{accessor_});
    phase_.sink.report(Path(accessor, "sparse"), std::move(finding));
  }

  DataPhase& phase_;
  std::uint32_t accessor_;
  Tally order_, range_;
};

void check_indices(DataPhase& phase, std::uint32_t index, const model::Sparse& sparse) {
  const Context& context = phase.context;
  const auto indices = model::sparse_indices(context.asset, context.views, phase.resources, sparse);
  if (!indices || !phase.budget.take(*sparse.count, 4)) return;
  const std::uint64_t elements = *context.views.accessors[index].count;
  SparseReport report(phase, index);
  std::uint64_t last = 0;
  for (std::uint64_t i = 0; i < *sparse.count; ++i) {
    const std::uint64_t value = indices->index(i);
    if (i != 0 && value <= last) report.note(true, {i, value, last});
    if (value >= elements) report.note(false, {i, value, elements});
    last = value;
  }
  report.finish();
}

constexpr FixEntry kSparseFixes[] = {{Code::ACCESSOR_SPARSE_INDICES_NON_INCREASING, sort_sparse}};

}  // namespace

const RuleGroup& sparse_rules() {
  static constexpr RuleGroup group{.fixes = kSparseFixes};
  return group;
}

void check_sparse_indices(DataPhase& phase) {
  const auto& accessors = phase.context.views.accessors;
  for (std::uint32_t i = 0; i < accessors.size(); ++i) {
    const model::Accessor& accessor = accessors[i];
    if (!accessor.count || !accessor.format.known()) continue;
    const auto sparse = model::read_sparse(phase.context.asset, accessor);
    if (!sparse) continue;
    // With a wrong count, other bytes are read as indices.
    const bool reported = *sparse->count > *accessor.count;
    if (reported && !phase.context.deviations.consequences_are_reported) continue;
    check_indices(phase, i, *sparse);
  }
}

}  // namespace gltfx::validate

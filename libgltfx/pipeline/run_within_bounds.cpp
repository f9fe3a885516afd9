// SPDX-License-Identifier: Apache-2.0
#include "pipeline/run_within_bounds.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "change/apply.hpp"
#include "change/place.hpp"
#include "prove/loss.hpp"

namespace gltfx {
namespace {

// Positions are tried with half of the bound before they are left.
constexpr int kPositionHalvings = 2;
// One for each quantity that may be left, and those.
constexpr int kMostRuns = 8;

Result<prove::LossProof> measure(const steps::StepInput& input, const change::Change& change) {
  auto placed = change::place(change, input.asset, nullptr);
  if (!placed) return placed.error();
  const auto after = change::apply(input.asset, *placed);
  if (!after) return after.error();
  prove::LossProof proof =
      prove::measure_loss(input.asset, *after, input.schemas, input.options.jobs);
  if (!proof.difference.empty()) {
    return Error{fmt::format("the new vertices would not mean the same: {}", proof.difference)};
  }
  return proof;
}

}  // namespace

Result<steps::StepOutcome> run_within_bounds(const steps::StepDescription& step,
                                             const steps::StepInput& input) {
  ConvertOptions options = input.options;
  for (int run = 0; run < kMostRuns; ++run) {
    input.unread.clear();
    auto outcome = step.run(
        {input.asset, input.schemas, options, input.file_name, input.unread, input.encodings});
    if (!outcome || outcome->change.empty() || !outcome->freedom.loss) return outcome;
    const auto proof = measure(input, outcome->change);
    if (!proof) return proof.error();
    const LossBounds& bounds = *input.options.quantize;
    bool within = true;
    for (const prove::MeasuredLoss& each : proof->losses) {
      const double bound = (bounds.*each.quantity).value_or(0);
      if (each.measured <= bound) {
        if (each.measured > 0) outcome->row.losses.push_back(prove::report_loss(each, bound));
        continue;
      }
      within = false;
      std::optional<double>& tried = (*options.quantize).*each.quantity;
      // Weights of joints move vertices, too.
      if (each.quantity == &LossBounds::position && !tried) options.quantize->weight.reset();
      const bool again =
          tried.has_value() && each.quantity == &LossBounds::position && run < kPositionHalvings;
      tried = again ? std::optional(*tried / 2) : std::nullopt;
    }
    if (within) return outcome;
  }
  return Error{"its loss would exceed the bounds"};
}

}  // namespace gltfx

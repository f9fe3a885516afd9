// SPDX-License-Identifier: Apache-2.0
#include "prove/loss.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "container/opened_files.hpp"
#include "model/image_sides.hpp"
#include "prove/meaning.hpp"

namespace gltfx::prove {
namespace {

/// A quantity and its name in reports and in Measured.
struct QuantityRow {
  std::optional<double> LossBounds::*member;
  std::string_view plural;
  std::string_view unit;
  double factor;  ///< from the stored value to the unit
  std::array<std::string_view, 2> measured;
};

constexpr std::array<QuantityRow, 6> kQuantities{{
    {&LossBounds::position, "positions", "%", 100, {"POSITION", ""}},
    {&LossBounds::normal, "normals", " deg", 1, {"NORMAL", "TANGENT"}},
    {&LossBounds::texcoord, "texture coordinates", " texel", 1, {"TEXCOORD", ""}},
    {&LossBounds::color, "colors", "", 1, {"COLOR", ""}},
    {&LossBounds::weight, "weights", "%", 100, {"WEIGHTS", ""}},
    {&LossBounds::animation, "animations", "%", 100, {"animation", ""}},
}};

double image_side(const model::OpenedAsset& opened, unsigned jobs) {
  container::OpenedFiles files(opened.resolver());
  const model::Asset asset(opened.document());
  return model::longest_image_side(
      model::load_resources(opened.container(), files, asset, opened.views(), jobs).data);
}

}  // namespace

LossProof measure_loss(const model::OpenedAsset& before, const model::OpenedAsset& after,
                       const schema::Set& schemas, unsigned jobs) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  MeaningRequest request;
  request.images = ImageComparison::bytes;
  request.regridded = true;
  request.animations = AnimationComparison::curves;
  request.tolerance = {kAny, kAny, kAny, kAny, kAny, kAny, kAny};
  request.jobs = jobs;
  request.most = 1;
  const Meaning meaning = compare_meaning(before, after, schemas, request);
  LossProof proof;
  if (!meaning.same()) {
    const Difference& first = meaning.differences.front();
    proof.difference = fmt::format("{}: {}", first.pointer, first.what);
  }
  for (const QuantityRow& row : kQuantities) {
    MeasuredLoss loss{row.member, 0};
    for (const Measured& each : meaning.measured) {
      if (each.quantity == row.measured[0] || each.quantity == row.measured[1])
        loss.measured = std::max(loss.measured, each.greatest);
    }
    if (row.member == &LossBounds::texcoord && loss.measured > 0)
      loss.measured *= image_side(before, jobs);
    proof.losses.push_back(loss);
  }
  return proof;
}

ConvertLoss report_loss(const MeasuredLoss& loss, double bound) {
  for (const QuantityRow& row : kQuantities) {
    if (row.member != loss.quantity) continue;
    return {std::string(row.plural), bound * row.factor, loss.measured * row.factor, row.unit};
  }
  return {};
}

}  // namespace gltfx::prove

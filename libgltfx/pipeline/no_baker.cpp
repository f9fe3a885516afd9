// SPDX-License-Identifier: Apache-2.0
// What a build without Embree (GLTFX_BAKE=OFF) has in place of the functions that render.
#include <gltfx/pipeline.hpp>

#include "pipeline/bake_asset.hpp"
#include "pipeline/cached_picture.hpp"
#include "pipeline/compare_pictures.hpp"
#include "pipeline/picture_check.hpp"

namespace gltfx {
namespace {

constexpr const char* kNoBaker = "this build cannot render: it was configured with GLTFX_BAKE=OFF";

BakeReport refusal(const std::string& path) {
  BakeReport report;
  report.path = path;
  report.problem = BakeProblem::refused;
  report.error = kNoBaker;
  return report;
}

}  // namespace

bool can_bake() { return false; }

Hash128 picture_key(const BakeOptions&, const ResultCache&) { return {}; }

std::string check_picture_name(const std::string&) { return kNoBaker; }

BakeReport bake_asset(validate::ValidatedAsset asset, const BakeOptions&) {
  return refusal(asset.asset().name());
}

BakeReport bake_file(const std::string& path, const BakeOptions&) { return refusal(path); }

BakedBytes bake_bytes(MemoryAsset asset, const BakeOptions&) {
  BakedBytes baked;
  baked.report = refusal(asset.name);
  return baked;
}

std::string bake_files(const std::vector<BakeInput>& inputs, const BakeOptions&,
                       const std::string& sheet, const std::function<void(BakeReport&&)>& consume) {
  for (const BakeInput& input : inputs) consume(refusal(input.path));
  return sheet.empty() ? "" : kNoBaker;
}

BakeComparison bake_comparison(const std::string& first, const std::string& second,
                               const BakeOptions&) {
  return {refusal(first), refusal(second), 0, 0, {}};
}

void draw_compared(std::optional<model::OpenedAsset>, std::optional<model::OpenedAsset>,
                   const std::vector<prove::ChangedBoxes>&, const CompareOptions&,
                   CompareReport& report) {
  report.picture_problem = kNoBaker;
}

PictureCheck::PictureCheck(const validate::ValidatedAsset&, const std::string&,
                           std::shared_ptr<const schema::Set>, unsigned)
    : obstacle_(kNoBaker) {}

std::string PictureCheck::find_difference(const validate::ValidatedAsset&) const { return {}; }

}  // namespace gltfx

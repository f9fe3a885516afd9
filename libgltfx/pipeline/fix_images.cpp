// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fix_images.hpp"

#include <gltfx/convert.hpp>

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "change/apply.hpp"
#include "change/chain.hpp"
#include "change/place.hpp"
#include "steps/image_encodings.hpp"
#include "steps/images.hpp"
#include "steps/layout.hpp"
#include "steps/used_bytes.hpp"

namespace gltfx {
namespace {

/// One asset whose images are converted.
class LegalRun {
 public:
  LegalRun(const model::OpenedAsset& asset, const schema::Set& schemas,
           const std::set<std::uint32_t>& images)
      : asset_(asset), schemas_(schemas), images_(images) {
    options_.images = {{ImageTarget::legal, std::nullopt}};
    // Other assets may refer to the old files, and convert them as well.
    options_.shared_folder = true;
  }

  LegalImages run() {
    auto outcome = steps::convert_images(input(asset_), &images_);
    if (!outcome) return fail(outcome.error().message);
    if (!unread_.empty()) outcome->trouble = unread_.front().reason;
    result_.trouble = std::move(outcome->trouble);
    take_notes(outcome->row.left);
    take_notes(outcome->row.refused);
    if (!result_.trouble.empty() || outcome->change.empty()) return std::move(result_);
    auto placed = change::place(std::move(outcome->change), asset_, nullptr);
    if (!placed) return fail(placed.error().message);
    if (auto error = lay_out(*placed)) return fail(error->message);
    change::drop_unnamed_files(*placed, *asset_.container().json);
    result_.change = *std::move(placed);
    return std::move(result_);
  }

 private:
  steps::StepInput input(const model::OpenedAsset& asset) {
    return {asset,   schemas_,  options_, std::filesystem::path(asset_.name()).filename().native(),
            unread_, encodings_};
  }

  LegalImages fail(const std::string& why) {
    for (const std::uint32_t image : images_) result_.left.emplace(image, why);
    return std::move(result_);
  }

  void take_notes(const std::vector<ConvertNote>& notes) {
    for (const std::uint32_t image : images_) {
      const std::string pointer = fmt::format("/images/{}", image);
      for (const ConvertNote& note : notes) {
        if (note.pointer == pointer) result_.left.emplace(image, note.reason);
      }
    }
  }

  // Moves bytes of a new buffer into those of the asset.
  std::optional<Error> lay_out(change::Change& all) {
    auto next = change::apply(asset_, all);
    if (!next) return next.error();
    auto layout = steps::lay_out(steps::UsedBytes(asset_, schemas_), input(*next));
    if (!layout) return layout.error();
    if (!layout->empty()) change::append(all, *layout, *asset_.container().json);
    return std::nullopt;
  }

  const model::OpenedAsset& asset_;
  const schema::Set& schemas_;
  const std::set<std::uint32_t>& images_;
  ConvertOptions options_;
  std::vector<ConvertNote> unread_;
  steps::ImageEncodings encodings_;
  LegalImages result_;
};

}  // namespace

LegalImages make_images_legal(const model::OpenedAsset& asset, const schema::Set& schemas,
                              const std::set<std::uint32_t>& images) {
  return LegalRun(asset, schemas, images).run();
}

}  // namespace gltfx

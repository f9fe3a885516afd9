// SPDX-License-Identifier: Apache-2.0
// What the report page says of each asset: the verdict, the facts, pictures.
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <new>
#include <string>
#include <utility>

#include "base/pages.hpp"
#include "container/base64.hpp"
#include "pipeline/asset_verbs.hpp"
#include "pipeline/bake_asset.hpp"
#include "pipeline/encode_pixels.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/kept_pictures.hpp"
#include "pipeline/open_asset.hpp"
#include "rules/shared_reports.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

constexpr std::uint32_t kSamples = 16;  // of a picture that is seen small
constexpr std::uint32_t kBounces = 4;
constexpr std::uint32_t kQuality = 82;  // WebP

BakeOptions bake_options(const ValidateOptions& options, const ThumbnailOptions& thumbnails,
                         unsigned jobs) {
  BakeOptions bake;
  bake.sizes = {{thumbnails.size, thumbnails.size}};
  if (thumbnails.quality) {
    bake.quality = *thumbnails.quality;
  } else {
    bake.samples = kSamples;
    bake.bounces = kBounces;
  }
  bake.root = options.root;
  bake.schemas = options.schemas;
  bake.jobs = jobs;
  return bake;
}

PagePicture picture_of(const BakeReport& baked) {
  PagePicture picture;
  picture.problem = baked.error;
  if (baked.problem != BakeProblem::none) return picture;
  const auto bytes = encode_pixels(baked.pixels, codec::EncodedFormat::webp, kQuality);
  if (!bytes) {
    picture.problem = bytes.error().message;
    return picture;
  }
  picture.uri = container::data_uri("image/webp", *bytes);
  picture.size = baked.pixels.width;
  return picture;
}

// What the page does not show, and nobody asks for who compares files with earlier ones.
void forget_embedded(FileReport& report) {
  if (!report.info) return;
  std::vector<ResourceInfo>& resources = report.info->resources;
  std::erase_if(resources, [](const ResourceInfo& each) { return each.storage != "external"; });
  resources.shrink_to_fit();
}

void inspect_and_draw(model::OpenedAsset opened, const ValidateOptions& options,
                      const BakeOptions* bake, unsigned jobs, KeptPictures& kept, PageAsset& page) {
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  if (find_inspection_obstacle(opened)) {
    page.inspection = inspect_asset(opened, *schemas, jobs);
    return;
  }
  opened.forget_views();
  validate::ValidatedAsset asset(std::move(opened), page.report, options);
  asset.forget_info();
  UpgradeOptions upgrade;
  upgrade.root = options.root;
  upgrade.schemas = schemas;
  UpgradeDryRun dry_run = dry_run_upgrade(asset, upgrade);
  give_back_memory();
  page.inspection = inspect_asset(asset.asset(), *schemas, jobs);
  add_upgrade(std::move(dry_run.report), page.inspection);
  if (bake == nullptr || kept.recall(page)) return;
  page.picture = picture_of(bake_asset(std::move(asset), *bake));
  if (dry_run.after) page.upgraded = picture_of(bake_asset(std::move(dry_run.after->asset), *bake));
  kept.keep(page);
}

// The library does not throw.
PageAsset collected(const ValidateInput& input, const ThumbnailOptions& thumbnails, unsigned jobs,
                    validate::SharedReports& shared) {
  const ValidateOptions& options = *input.options;
  PageAsset page;
  std::string why;
  try {
    const bool draws = thumbnails.draw && can_bake();
    const BakeOptions bake = bake_options(options, thumbnails, jobs);
    KeptPictures kept(input.path, options, bake);
    if (draws) kept.look_up();
    Validation validation = validate_path(input.path, options, &shared);
    page.report = std::move(validation.report);
    forget_embedded(page.report);
    if (!page.report.readable) return page;
    if (!validation.asset) {  // the report was kept
      auto opened = open_asset(input.path, AssetBounds::of(options));
      if (opened) {
        validation.asset = *std::move(opened);
      } else {
        why = opened.error().message;
      }
    }
    if (validation.asset) {
      if (draws) kept.look_up(*validation.asset);
      inspect_and_draw(*std::move(validation.asset), options, draws ? &bake : nullptr, jobs, kept,
                       page);
      return page;
    }
  } catch (const std::bad_alloc&) {
    why = "there is not enough memory to inspect the file";
  } catch (const std::filesystem::filesystem_error&) {
    why = "the path cannot be looked up";
  }
  PageAsset failed;
  failed.report = std::move(page.report);
  failed.inspection.path = input.path;
  failed.inspection.error = std::move(why);
  return failed;
}

PageAsset collected_for_targets(const ValidateInput& input, const ThumbnailOptions& thumbnails,
                                unsigned jobs, validate::SharedReports& shared) {
  PageAsset page = collected(input, thumbnails, jobs, shared);
  for (const TargetChoice& choice : input.options->targets) page.targets.push_back(choice.label());
  return page;
}

}  // namespace

void report_files(std::span<const ValidateInput> inputs, const ThumbnailOptions& thumbnails,
                  unsigned jobs, const std::function<void(PageAsset&&)>& consume) {
  // Many files keep all threads busy by themselves.
  const unsigned each = inputs.size() == 1 ? jobs : 1;
  validate::SharedReports shared;
  report_in_order<PageAsset>(
      inputs.size(), jobs,
      [&](std::size_t i) { return collected_for_targets(inputs[i], thumbnails, each, shared); },
      consume);
}

}  // namespace gltfx

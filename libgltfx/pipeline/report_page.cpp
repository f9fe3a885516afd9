// SPDX-License-Identifier: Apache-2.0
// What the report page says of each asset: the verdict, the facts, pictures.
#include <gltfx/pipeline.hpp>

#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "codec/client.hpp"
#include "container/base64.hpp"
#include "pipeline/bake_asset.hpp"
#include "pipeline/in_order.hpp"
#include "pipeline/upgraded_asset.hpp"

namespace gltfx {
namespace {

constexpr std::uint32_t kSamples = 16;  // of a picture that is seen small
constexpr std::uint32_t kBounces = 4;
constexpr std::uint32_t kQuality = 82;  // WebP

/// One asset on its way.
class Collector {
 public:
  Collector(const ValidateInput& input, const PageWishes& wishes, unsigned jobs)
      : path_(input.path), options_(*input.options), wishes_(wishes), jobs_(jobs) {}

  PageAsset run() {
    PageAsset asset;
    asset.report = validate_file(path_, options_);
    if (!asset.report.readable) return asset;
    InspectOptions inspect;
    inspect.root = options_.root;
    inspect.schemas = options_.schemas;
    inspect.jobs = jobs_;
    asset.inspection = inspect_file(path_, inspect);
    if (!wishes_.pictures || !asset.inspection.facts) return asset;
    asset.picture = picture_of(bake_file(path_, bake_options()));
    if (asset.inspection.upgrade_problem.empty()) draw_upgraded(asset);
    return asset;
  }

 private:
  BakeOptions bake_options() const {
    BakeOptions bake;
    bake.sizes = {{wishes_.picture_size, wishes_.picture_size}};
    bake.samples = kSamples;
    bake.bounces = kBounces;
    bake.force = true;  // who looks for a fault wants to see it
    bake.root = options_.root;
    bake.schemas = options_.schemas;
    bake.jobs = jobs_;
    return bake;
  }

  void draw_upgraded(PageAsset& asset) const {
    bool changes = false;
    for (const UpgradeFact& fact : asset.inspection.upgrade) changes = changes || fact.done;
    if (!changes) return;
    UpgradeOptions upgrade;
    upgrade.root = options_.root;
    upgrade.schemas = options_.schemas;
    auto upgraded = upgraded_asset(path_, upgrade);
    if (!upgraded) {
      asset.upgraded.emplace().problem = "'gltfx upgrade' would refuse the file and say why";
      return;
    }
    asset.upgraded = picture_of(bake_asset(path_, *std::move(upgraded), bake_options()));
  }

  static PagePicture picture_of(const BakeReport& baked) {
    PagePicture picture;
    picture.problem = baked.error;
    if (baked.problem != BakeProblem::none) return picture;
    const BakedPixels& pixels = baked.pixels;
    codec::EncodeRequest request;
    request.format = codec::EncodedFormat::webp;
    request.raster = {pixels.width, pixels.height, pixels.channels, 8};
    request.quality = kQuality;
    request.pixels = std::as_bytes(std::span(pixels.bytes));
    const auto encoded = codec::Client::shared().encode_image(request);
    if (const auto* fault = std::get_if<codec::Fault>(&encoded)) {
      picture.problem = "the picture cannot be encoded: " + fault->message;
      return picture;
    }
    const auto& file = std::get<codec::EncodedImage>(encoded);
    const std::string_view bytes(reinterpret_cast<const char*>(file.bytes.data()),
                                 file.bytes.size());
    picture.uri = fmt::format("data:image/webp;base64,{}", container::encode_base64(bytes));
    picture.size = pixels.width;
    return picture;
  }

  const std::string& path_;
  const ValidateOptions& options_;
  const PageWishes& wishes_;
  unsigned jobs_;
};

// The library does not throw.
PageAsset collected(const ValidateInput& input, const PageWishes& wishes, unsigned jobs) {
  std::string why;
  try {
    return Collector(input, wishes, jobs).run();
  } catch (const std::bad_alloc&) {
    why = "there is not enough memory to inspect the file";
  } catch (const std::filesystem::filesystem_error&) {
    why = "the path cannot be looked up";
  }
  PageAsset asset;
  asset.report = validate_file(input.path, *input.options);
  asset.inspection.error = std::move(why);
  return asset;
}

}  // namespace

void report_files(std::span<const ValidateInput> inputs, const PageWishes& wishes, unsigned jobs,
                  const std::function<void(PageAsset&&)>& consume) {
  // Many files keep all threads busy by themselves.
  const unsigned each = inputs.size() == 1 ? jobs : 1;
  report_in_order<PageAsset>(
      inputs.size(), jobs, [&](std::size_t i) { return collected(inputs[i], wishes, each); },
      consume);
}

}  // namespace gltfx

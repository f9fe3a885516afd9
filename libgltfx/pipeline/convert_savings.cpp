// SPDX-License-Identifier: Apache-2.0
#include "pipeline/convert_savings.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "base/checked.hpp"
#include "inspect/facts.hpp"
#include "pipeline/edit_asset.hpp"
#include "steps/layout.hpp"
#include "steps/stages.hpp"
#include "steps/step.hpp"
#include "steps/stored_size.hpp"

namespace gltfx {
namespace {

struct Trial {
  std::string_view option;
  void (*set)(ConvertOptions& options);
};

constexpr std::array<Trial, 5> kTrials{
    {{"--prune", [](ConvertOptions& options) { options.prune = true; }},
     {"--weld", [](ConvertOptions& options) { options.weld = true; }},
     {"--resample", [](ConvertOptions& options) { options.resample = true; }},
     {"--dedup", [](ConvertOptions& options) { options.dedup = true; }},
     {"--compress meshopt",
      [](ConvertOptions& options) { options.compress = Compression::meshopt; }}}};

struct SideLimit {
  std::string_view option;
  std::uint32_t texels;
};
constexpr std::array<SideLimit, 2> kSideLimits{
    {{"--texture-size 2048", 2048}, {"--texture-size 1024", 1024}}};

std::uint64_t less(std::uint64_t before, std::uint64_t after) {
  return before > after ? before - after : 0;
}

/// Tries options on one asset.
class Trials {
 public:
  Trials(const model::OpenedAsset& asset, const schema::Set& schemas, const ConvertOptions& options,
         steps::ImageEncodings& encodings)
      : asset_(asset),
        schemas_(schemas),
        options_(options),
        encodings_(encodings),
        used_(asset, schemas),
        bytes_(steps::stored_size(asset)) {}

  AssetFacts facts_of(const model::OpenedAsset& asset) const {
    InspectOptions options;
    options.jobs = options_.jobs;
    return inspect::collect_facts(asset, schemas_, options);
  }

  // What the option saves; nothing: it changes nothing, or is refused.
  std::optional<ConvertSaving> run(const Trial& trial, std::uint64_t mesh_bytes) const {
    ConvertOptions options = options_;
    trial.set(options);
    steps::Stages stages(asset_);
    for (const steps::StepDescription& step : steps::steps()) {
      if (!step.asked(options)) continue;
      std::vector<ConvertNote> unread;
      auto outcome = step.run({stages.asset(), schemas_, options, {}, unread, encodings_});
      if (!outcome || !unread.empty()) return std::nullopt;
      if (outcome->change.empty()) continue;
      if (stages.add(std::move(outcome->change)) || stages.apply()) return std::nullopt;
    }
    if (stages.all().empty()) return std::nullopt;
    std::vector<ConvertNote> unread;
    auto layout =
        steps::lay_out(used_, {stages.asset(), schemas_, options, "a.gltf", unread, encodings_});
    if (!layout || stages.add(*std::move(layout)) || stages.apply()) return std::nullopt;
    const std::uint64_t after = steps::stored_size(stages.asset());
    // Streams are decoded before they go to the graphics card.
    const std::uint64_t meshes =
        options.compress ? mesh_bytes : facts_of(stages.asset()).mesh_gpu_bytes();
    return ConvertSaving{trial.option, less(bytes_, after), less(mesh_bytes, meshes)};
  }

 private:
  const model::OpenedAsset& asset_;
  const schema::Set& schemas_;
  const ConvertOptions& options_;
  steps::ImageEncodings& encodings_;
  const steps::UsedBytes used_;
  const std::uint64_t bytes_;
};

// Memory that is free if no side of an image is longer.
std::uint64_t texels_saved(const std::vector<ImageFacts>& images, std::uint32_t most) {
  std::uint64_t saved = 0;
  for (const ImageFacts& image : images) {
    const std::uint64_t side = std::max(image.width, image.height);
    if (side <= most || !image.encoding.empty()) continue;
    const double scale = static_cast<double>(most) / static_cast<double>(side);
    const auto after =
        static_cast<std::uint64_t>(static_cast<double>(image.gpu_bytes) * scale * scale);
    saved = saturating_add(saved, less(image.gpu_bytes, after));
  }
  return saved;
}

}  // namespace

bool asks_nothing(const ConvertOptions& options) {
  if (writes(options) || options.diff || options.to || !options.targets.empty()) return false;
  const auto all = steps::steps();
  return std::none_of(all.begin(), all.end(),
                      [&](const steps::StepDescription& step) { return step.asked(options); });
}

void find_savings(const model::OpenedAsset& asset, const schema::Set& schemas,
                  const ConvertOptions& options, steps::ImageEncodings& encodings,
                  ConvertReport& report) {
  if (!asset.document().is_object(asset.document().root())) return;
  const Trials trials(asset, schemas, options, encodings);
  const AssetFacts facts = trials.facts_of(asset);
  report.gpu_image_bytes = facts.image_gpu_bytes();
  report.gpu_mesh_bytes = facts.mesh_gpu_bytes();
  const auto add = [&](const ConvertSaving& saving) {
    if (saving.bytes > 0 || saving.gpu_bytes > 0) report.savings.push_back(saving);
  };
  for (const Trial& trial : kTrials) {
    if (const auto saving = trials.run(trial, report.gpu_mesh_bytes)) add(*saving);
  }
  for (const SideLimit& limit : kSideLimits) {
    add({limit.option, 0, texels_saved(facts.images, limit.texels)});
  }
}

}  // namespace gltfx

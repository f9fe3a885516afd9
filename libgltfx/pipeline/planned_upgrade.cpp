// SPDX-License-Identifier: Apache-2.0
#include "pipeline/planned_upgrade.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/pages.hpp"
#include "edit/companions.hpp"
#include "edit/orphans.hpp"
#include "edit/prune.hpp"
#include "edit/references.hpp"
#include "edit/rewrite.hpp"
#include "edit/write_asset.hpp"
#include "pipeline/edit_asset.hpp"
#include "upgrade/ambiguity.hpp"
#include "upgrade/asset_pictures.hpp"
#include "upgrade/plan.hpp"
#include "upgrade/render.hpp"
#include "upgrade/settlement.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using model::OpenedAsset;

PlannedUpgrade without_plan(PlannedUpgrade planned, EditProblem problem, std::string error) {
  return {failed(std::move(planned.report), problem, std::move(error)), {}, {}, {}, {}};
}

bool is_lossless(const std::vector<UpgradeAction>& actions) {
  return std::all_of(actions.begin(), actions.end(), [](const UpgradeAction& action) {
    return !action.is_due() || (action.fate == UpgradeFate::safe && !action.lossy);
  });
}

// A new name is one that is free, or taken by the same bytes, where the asset is and where it goes.
bool is_free(const OpenedAsset& asset, const std::string& output, const std::string& path,
             std::string_view content) {
  const container::Resolved here = asset.resolver().open(path);
  if (here.error == container::ResolveError::none
          ? here.bytes.text() != content
          : here.error != container::ResolveError::not_found) {
    return false;
  }
  const fs::path there = edit::target_folder(asset.name(), output) / path;
  std::error_code error;
  return !fs::exists(fs::symlink_status(there, error)) ||
         edit::has_bytes(there,
                         {std::as_bytes(std::span(content.data(), content.size())), nullptr});
}

// Makes new images and finds a place for all that is added.
Result<upgrade::Settlement> settle(const upgrade::Additions& additions, const OpenedAsset& asset,
                                   const std::string& output, const upgrade::AssetBytes& bytes,
                                   upgrade::Pictures& pictures) {
  std::vector<std::shared_ptr<const std::string>> images;
  for (const upgrade::ImageJob& job : additions.images()) {
    auto file = upgrade::render(job, pictures, upgrade::ImageCache::shared(), bytes.origin());
    if (!file) return file.error();
    images.push_back(*std::move(file));
  }
  return upgrade::settle(additions, images, asset.container(), bytes,
                         [&](const std::string& path, std::string_view content) {
                           return is_free(asset, output, path, content);
                         });
}

std::vector<UpgradeOrphan> listed(const edit::Orphans& orphans, const OpenedAsset& asset) {
  std::vector<UpgradeOrphan> list;
  const model::Asset elements(asset.document());
  upgrade::AssetBytes bytes(elements, asset.container(), asset.resolver());
  for (const auto& [array, indices] : orphans) {
    for (const std::uint64_t index : indices) {
      UpgradeOrphan orphan{fmt::format("/{}/{}", array, index), 0, false};
      if (array == "images") {
        const auto content = bytes.image(index);
        orphan.bytes = content ? content->size() : 0;
      }
      list.push_back(std::move(orphan));
    }
  }
  return list;
}

SharedText new_text(const OpenedAsset& asset, const std::vector<json::Edit>& edits) {
  return share_text(json::apply_edits(*asset.container().json, edits));
}

/// What the old document says of orphans.
struct Before {
  edit::Orphans referred;
  std::optional<std::uint64_t> bin_size;  ///< where buffer 0 is the BIN chunk of a GLB
};

Before look_at_old(const OpenedAsset& asset, const std::vector<std::uint64_t>& released,
                   const schema::Set& schemas, const upgrade::AssetBytes& bytes) {
  const json::Document& document = asset.document();
  const edit::References references(document, schemas);
  Before before{edit::referred_elements(document, references, released), std::nullopt};
  if (bytes.buffer_storage(0) == upgrade::Storage::bin_chunk) {
    before.bin_size = asset.container().bin->length;
  }
  return before;
}

// What additions refer to is not missed: they stand behind everything that was there before. The
// old and the new document are not looked at together.
void look_for_orphans(const OpenedAsset& asset, Before before, const UpgradeOptions& options,
                      const schema::Set& schemas, std::vector<json::Edit>& edits,
                      PlannedUpgrade& planned) {
  planned.parsed = json::parse(planned.text);
  const json::Document& now = planned.parsed.document;
  const edit::References after(now, schemas);
  const edit::Orphans orphans = edit::find_orphans(std::move(before.referred), now, after);
  if (std::all_of(orphans.begin(), orphans.end(),
                  [](const auto& of) { return of.second.empty(); })) {
    return;
  }
  std::optional<Result<edit::Pruned>> pruned;
  if (options.prune) pruned = edit::prune(now, after, orphans, before.bin_size);
  if (asset.is_large()) planned.parsed = {};
  UpgradeReport& report = planned.report;
  report.orphans = listed(orphans, asset);
  if (!pruned) return;
  if (!*pruned) {
    report.orphans_kept = pruned->error().message;
    return;
  }
  edits = json::chain_edits(*asset.container().json, edits, (*pruned)->edits);
  planned.bin.cut = std::move((*pruned)->cut);
  for (UpgradeOrphan& orphan : report.orphans) orphan.removed = true;
  report.names_removed = std::move((*pruned)->names);
  planned.text = new_text(asset, edits);
  planned.parsed = {};  // the text is another one by now
}

// Said with the plan: what is valid may still not be seen.
void note_targets(const std::vector<TargetChoice>& targets, std::vector<UpgradeAction>& actions) {
  for (UpgradeAction& action : actions) {
    if (!action.is_due()) continue;
    for (const TargetChoice& choice : targets) {
      const auto found = choice.target->features.find(action.to);
      if (found == choice.target->features.end()) continue;
      const TargetRange* range = outcome_of(found->second.used, choice.version);
      if (range == nullptr || range->outcome != TargetOutcome::ignored) continue;
      action.notes.push_back(fmt::format("{} ignores {}", choice.label(), action.to));
    }
  }
}

}  // namespace

UpgradeReport failed(UpgradeReport report, EditProblem problem, std::string error) {
  note_failure(report, problem, std::move(error));
  for (UpgradeAction& action : report.actions) action.done = false;
  report.new_files.clear();
  report.new_warnings.clear();
  report.verified = false;
  report.orphans.clear();
  return report;
}

PlannedUpgrade plan_upgrade(const validate::ValidatedAsset& validated,
                            const UpgradeOptions& options,
                            const std::shared_ptr<const schema::Set>& schemas,
                            const std::function<void()>& release) {
  const OpenedAsset& asset = validated.asset();
  const model::Asset elements(asset.document());
  upgrade::AssetBytes bytes(elements, asset.container(), asset.resolver());
  upgrade::AssetPictures pictures(bytes, upgrade::ImageCache::shared());
  upgrade::Plan plan = upgrade::make_plan(asset.document(), *schemas, options, &pictures, &bytes);
  PlannedUpgrade planned;
  UpgradeReport& report = planned.report;
  report.path = asset.name();
  if (const std::string why = pictures.failure(); !why.empty()) {
    return without_plan(std::move(planned), EditProblem::unreadable, why);
  }
  const auto ambiguity = upgrade::find_ambiguity(asset.parsed(), plan);
  report.actions = std::move(plan.actions);
  note_targets(options.targets, report.actions);
  std::vector<json::Edit> edits = std::move(plan.edits);
  if (report.due() == 0) return planned;
  const auto refuse = [&planned](std::string why) {
    return without_plan(std::move(planned), EditProblem::refused, std::move(why));
  };
  if (ambiguity) return refuse(*ambiguity);
  const auto obstacle = edit::find_glb_obstacle(asset.container());
  if (obstacle && !edits.empty()) return refuse("it cannot be written anew: " + *obstacle);
  report.changes = !edits.empty() || !plan.additions.empty();
  if (options.strict && !is_lossless(report.actions)) {
    return refuse("not everything can be upgraded without loss (--strict)");
  }
  if (!plan.additions.empty()) {
    auto settled = settle(plan.additions, asset, options.output, bytes, pictures);
    if (!settled) return refuse(settled.error().message);
    edits = json::merge_edits(std::move(edits), std::move(settled->edits));
    planned.bin.more = std::move(settled->bin);
    planned.files = std::move(settled->files);
    for (const edit::NewFile& file : planned.files) report.new_files.push_back(file.path);
  }
  if (!report.changes) return planned;
  planned.text = new_text(asset, edits);
  std::optional<Before> before;
  if (elements.count(model::RootArray::textures) > 0) {
    before = look_at_old(asset, plan.released, *schemas, bytes);
  }
  release();
  if (!options.prune && !options.diff) edits = {};
  give_back_memory();
  if (before) look_for_orphans(asset, *std::move(before), options, *schemas, edits, planned);
  release();
  if (options.diff) report.diff = diff_of(asset, edits);
  return planned;
}

OpenedAsset upgraded(const OpenedAsset& before, PlannedUpgrade& plan,
                     container::Container changed) {
  container::Resolver resolver = before.resolver();
  for (const edit::NewFile& file : plan.files) resolver.add(file.path, file.content());
  if (!plan.text || !changed.json || !edit::same_but_for_padding(*changed.json, *plan.text)) {
    return {before.name(), std::move(changed), std::move(resolver)};
  }
  // The same text is not to be held twice.
  if (changed.bytes.text() == *plan.text) changed.bytes = container::Bytes::from_text(plan.text);
  changed.json = std::exchange(plan.text, nullptr);
  if (plan.parsed.document.empty()) {
    return {before.name(), std::move(changed), std::move(resolver)};
  }
  return {before.name(), std::move(changed), std::move(resolver), std::move(plan.parsed)};
}

}  // namespace gltfx

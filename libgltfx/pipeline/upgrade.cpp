// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/file_state.hpp"
#include "base/material_table.hpp"
#include "pipeline/asset_verbs.hpp"
#include "pipeline/change_check.hpp"
#include "pipeline/edit_bytes.hpp"
#include "pipeline/edit_files.hpp"
#include "pipeline/external_needs.hpp"
#include "pipeline/open_asset.hpp"
#include "pipeline/picture_check.hpp"
#include "pipeline/planned_upgrade.hpp"
#include "prove/findings.hpp"
#include "rules/validated_asset.hpp"
#include "schema/compile.hpp"
#include "steps/upgrade/ambiguity.hpp"
#include "steps/upgrade/plan.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::ValidatedAsset;
using SchemaSet = std::shared_ptr<const schema::Set>;

SchemaSet schemas_of(const UpgradeOptions& options) {
  return options.schemas ? options.schemas : schema::builtin_set();
}

UpgradeReport report_on(const std::string& path) {
  UpgradeReport report;
  report.path = path;
  return report;
}

UpgradeReport unreadable(const std::string& path, std::string why) {
  return failed(report_on(path), EditProblem::unreadable, std::move(why));
}

// A container of glTF 1.0, of which the text has another meaning.
std::optional<UpgradeReport> find_old_container(const OpenedAsset& asset,
                                                const UpgradeOptions& options) {
  if (asset.container().glb_version != 1U) return std::nullopt;
  UpgradeReport report = report_on(asset.name());
  report.actions.push_back(upgrade::old_format(options));
  return report;
}

// What an old material looked like is not known where gltfx does not draw its extension.
std::string find_undrawn(const std::vector<UpgradeAction>& actions) {
  constexpr std::span kDrawn(material_table::kTexts);
  for (const UpgradeAction& action : actions) {
    if (!action.done || action.from.find("_materials_") == std::string::npos) continue;
    const bool drawn = std::any_of(kDrawn.begin(), kDrawn.end(), [&](const MaterialText& text) {
      return text.extension == action.from;
    });
    if (!drawn) return fmt::format("gltfx does not draw {}", action.from);
  }
  return {};
}

/// What has to hold of the new asset.
class Verifier {
 public:
  /// `actions`: of the upgrade.
  Verifier(const ValidatedAsset& before, const SchemaSet& schemas, const UpgradeOptions& options,
           const std::vector<UpgradeAction>& actions)
      : before_(before),
        schemas_(schemas),
        verify_(options.verify),
        jobs_(options.jobs),
        obstacle_(options.verify ? find_undrawn(actions) : std::string()) {
    if (!options.verify || !obstacle_.empty()) return;
    pictures_.emplace(before, options.root, schemas, options.jobs);
    obstacle_ = pictures_->obstacle();
  }

  /// Why `after` may not take the place of the old asset, or nothing.
  std::optional<std::string> find_error(const ValidatedAsset& after, UpgradeReport& report) const {
    prove::NewFindings found = prove::new_findings(before_, after, schemas_);
    report.new_warnings = std::move(found.warnings);
    if (!found.error.empty()) {
      return fmt::format(
          "the new file would have the new error {}; fix the findings of 'gltfx validate' first",
          found.error);
    }
    if (!verify_) return std::nullopt;
    // Small pictures of one scene would not show each change.
    ChangeCheck check =
        check_changes(before_.asset(), after.asset(), *schemas_, changes_of_upgrade(), jobs_);
    if (!check.difference.empty()) return check.difference + " (--verify)";
    const std::string unread = std::move(check.unproven);
    report.not_verified = obstacle_.empty() ? unread : obstacle_;
    if (!obstacle_.empty()) return std::nullopt;
    std::string difference = pictures_->find_difference(after);
    if (!difference.empty()) return difference + " (--verify)";
    report.verified = unread.empty();
    return std::nullopt;
  }

 private:
  const ValidatedAsset& before_;
  const SchemaSet& schemas_;
  bool verify_;
  unsigned jobs_;
  std::string obstacle_;  // why there are no pictures
  std::optional<PictureCheck> pictures_;
};

// With findings only: nothing else is to be held beside the new document.
ValidatedAsset validated(OpenedAsset asset, const SchemaSet& schemas) {
  ValidatedAsset validated(std::move(asset), validate::default_validation(schemas));
  validated.forget_views();
  validated.forget_info();
  return validated;
}

// The report says all of it where it succeeds.
UpgradeReport written(UpgradeReport report, bool succeeded) {
  if (succeeded) return report;
  const EditProblem problem = report.problem;
  std::string error = std::move(report.error);
  return failed(std::move(report), problem, std::move(error));
}

// Judged alike whether it is written or not.
UpgradeDryRun carry_out(const ValidatedAsset& before, const FileState& state,
                        PlannedUpgrade planned, const SchemaSet& schemas,
                        const UpgradeOptions& options, FolderIndex& folders) {
  UpgradeReport& report = planned.report;
  const Verifier verifier(before, schemas, options, report.actions);
  auto after = carry_out(
      {before.asset(), state, options, schemas, folders}, std::move(planned.change),
      [&](const ValidatedAsset& draft) { return verifier.find_error(draft, report); }, report,
      std::move(planned.now));
  const bool done = after.has_value();
  return {written(std::move(report), done), std::move(after)};
}

UpgradeReport copy(const OpenedAsset& asset, const FileState& state, UpgradeReport report,
                   const UpgradeOptions& options) {
  const bool copied = copy_unchanged(asset, state, options, report);
  return written(std::move(report), copied);
}

UpgradeDryRun upgrade_opened(EditedAsset opened, const UpgradeOptions& options,
                             FolderIndex& folders) {
  OpenedAsset& asset = opened.asset;
  const FileState& state = opened.state;
  const std::string path = asset.name();
  if (auto report = find_old_container(asset, options)) return {*std::move(report), {}};
  if (const auto obstacle = find_obstacle(asset)) return {unreadable(path, obstacle->message), {}};
  const SchemaSet schemas = schemas_of(options);
  if (options.gltf.empty() && !upgrade::names_legacy(asset.document(), *schemas)) {
    return {copy(asset, state, report_on(path), options), {}};
  }
  ValidatedAsset before = validated(std::move(asset), schemas);
  PlannedUpgrade planned =
      plan_upgrade(before, options, schemas, [&before] { before.forget_large_document(); });
  if (planned.report.problem != EditProblem::none) return {std::move(planned.report), {}};
  if (!planned.report.changes) {
    return {copy(before.asset(), state, std::move(planned.report), options), {}};
  }
  return carry_out(before, state, std::move(planned), schemas, options, folders);
}

std::vector<std::string> legacy_below(const OpenedAsset& asset, const UpgradeOptions& options) {
  const SchemaSet schemas = schemas_of(options);
  return external_assets_where(asset, [&schemas](const OpenedAsset& child) {
    return upgrade::names_legacy(child.document(), *schemas);
  });
}

UpgradeDryRun upgrade_with_note(EditedAsset opened, const UpgradeOptions& options,
                                FolderIndex& folders) {
  std::vector<std::string> external = legacy_below(opened.asset, options);
  UpgradeDryRun upgraded = upgrade_opened(std::move(opened), options, folders);
  upgraded.report.external_assets = std::move(external);
  return upgraded;
}

UpgradeReport upgrade_path(const std::string& path, const UpgradeOptions& options,
                           FolderIndex& folders) {
  return edit_file<UpgradeReport>(
      path, options, "upgrade", [&](EditedAsset opened, UpgradeReport& report) {
        report = upgrade_with_note(std::move(opened), options, folders).report;
      });
}

}  // namespace

UpgradeDryRun dry_run_upgrade(ValidatedAsset& asset, const UpgradeOptions& options) {
  UpgradeDryRun dry_run;
  const auto try_upgrade = [&](UpgradeReport& report) {
    if (auto old = find_old_container(asset.asset(), options)) {
      report = *std::move(old);
      return;
    }
    const SchemaSet schemas = schemas_of(options);
    const auto forget = [&asset] { asset.forget_large_document(); };
    PlannedUpgrade planned = plan_upgrade(asset, options, schemas, forget);
    if (planned.report.changes) {
      FolderIndex folders;
      UpgradeDryRun tried = carry_out(asset, {}, std::move(planned), schemas, options, folders);
      dry_run.after = std::move(tried.after);
      report = std::move(tried.report);
    } else {
      report = std::move(planned.report);
    }
  };
  dry_run.report = guarded<UpgradeReport>(asset.asset().name(), "upgrade", try_upgrade);
  return dry_run;
}

UpgradeReport upgrade_file(const std::string& path, const UpgradeOptions& options) {
  FolderIndex folders;
  return upgrade_path(path, options, folders);
}

EditedBytes<UpgradeReport> upgrade_bytes(MemoryAsset asset, const UpgradeOptions& options) {
  return edit_bytes<UpgradeReport>(
      std::move(asset), options, [&](EditedAsset opened, UpgradeReport& report) {
        FolderIndex folders;
        UpgradeDryRun upgraded = upgrade_with_note(std::move(opened), options, folders);
        report = std::move(upgraded.report);
        return std::move(upgraded.after);
      });
}

void upgrade_files(const std::vector<EditInput>& inputs, const UpgradeOptions& options,
                   unsigned jobs, const std::function<void(UpgradeReport&&)>& consume) {
  edit_files(inputs, options, jobs, upgrade_path, consume);
}

}  // namespace gltfx

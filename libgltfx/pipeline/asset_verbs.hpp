// SPDX-License-Identifier: Apache-2.0
/// Verbs for callers that opened or validated the asset already.
#pragma once

#include <gltfx/inspect.hpp>
#include <gltfx/report.hpp>
#include <gltfx/upgrade.hpp>
#include <gltfx/validate.hpp>

#include <optional>
#include <string>

#include "model/opened_asset.hpp"
#include "pipeline/edit_asset.hpp"
#include "rules/validated_asset.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// As validate_bytes(), of what was opened: fixes are proposed where the options ask for them.
/// `shared`: as validate::validate() takes it, likewise below.
validate::ValidatedAsset validate_asset(model::OpenedAsset asset, const ValidateOptions& options,
                                        validate::SharedReports* shared = nullptr);

/// A report, and the asset where it had to be opened.
struct Validation {
  FileReport report;
  std::optional<model::OpenedAsset> asset;  ///< nothing: unreadable, or the report was kept
};

/// As validate_file(), which gives the report alone.
Validation validate_path(const std::string& path, const ValidateOptions& options,
                         validate::SharedReports* shared = nullptr);

/// An upgrade that is not written.
struct UpgradeDryRun {
  UpgradeReport report;
  /// The asset as it would be written, new images included; nothing where nothing changes, or there
  /// is a problem.
  std::optional<Draft> after;
};

/// As upgrade_file() without output; does not throw. `options` ask for no output; their schemas are
/// those that the asset was validated with. Large documents of both assets are forgotten.
UpgradeDryRun dry_run_upgrade(validate::ValidatedAsset& asset, const UpgradeOptions& options);

/// As inspect_file(), without what an upgrade would do. An upgrade holds two documents: it is
/// tried before there are facts to hold beside them.
InspectReport inspect_asset(const model::OpenedAsset& asset, const schema::Set& schemas,
                            unsigned jobs);

/// Why there is nothing to inspect, as half a sentence; nothing when there is.
std::optional<Error> find_inspection_obstacle(const model::OpenedAsset& asset);

/// Adds what an upgrade would do to the report on the same asset.
void add_upgrade(UpgradeReport upgrade, InspectReport& report);

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
/// An asset that was validated: what may be planned, drawn or converted.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <cstddef>
#include <memory>
#include <utility>

#include "model/opened_asset.hpp"
#include "rules/fix_entry.hpp"

namespace gltfx::validate {

/// An asset with the report that validation made of it. It may have any errors: who goes on with it
/// looks at the report.
class ValidatedAsset {
 public:
  /// Validates.
  ValidatedAsset(model::OpenedAsset asset, const ValidateOptions& options);
  /// `report` is of an earlier validation of the same bytes with the same options.
  ValidatedAsset(model::OpenedAsset asset, FileReport report, const ValidateOptions& options);

  const model::OpenedAsset& asset() const { return asset_; }
  const FileReport& report() const { return report_; }
  /// What findings with a fix mark; empty where the report is of an earlier validation.
  const Sites& sites() const { return sites_; }
  /// For what is said of findings beside them.
  FileReport& report() { return report_; }
  /// Whether the report has all errors and warnings that default options give.
  bool validated_by_default() const { return by_default_; }
  /// Says how a finding, by its place in the report, can be fixed.
  void propose(std::size_t finding, std::shared_ptr<const ProposedFix> fix) {
    report_.diagnostics[finding].fix = std::move(fix);
  }

  /// Gives back the memory of tables that may be large.
  void forget_views() { asset_.forget_views(); }
  void forget_large_document() { asset_.forget_large_document(); }
  /// Gives back what the report has beside findings.
  void forget_info() { report_.info.reset(); }
  /// For who needs nothing else any more.
  FileReport take_report() { return std::move(report_); }
  model::OpenedAsset take_asset() { return std::move(asset_); }

 private:
  model::OpenedAsset asset_;
  Sites sites_;
  FileReport report_;
  bool by_default_;
};

}  // namespace gltfx::validate

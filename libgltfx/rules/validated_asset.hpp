// SPDX-License-Identifier: Apache-2.0
/// An asset with its report, for changes, rendering or conversion.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <cstddef>
#include <memory>
#include <utility>

#include "model/opened_asset.hpp"
#include "rules/fix_entry.hpp"

namespace gltfx::validate {

class SharedReports;

/// An asset with its validation report. It may have any errors: callers check the report.
class ValidatedAsset {
 public:
  /// Validates the asset; `shared` as validate() takes it.
  ValidatedAsset(model::OpenedAsset asset, const ValidateOptions& options,
                 SharedReports* shared = nullptr);
  /// `report` is the report of an earlier validation of the same bytes with the same options.
  ValidatedAsset(model::OpenedAsset asset, FileReport report, const ValidateOptions& options);

  const model::OpenedAsset& asset() const { return asset_; }
  const FileReport& report() const { return report_; }
  /// The places of findings with a fix; empty if the report is from an earlier validation.
  const Sites& sites() const { return sites_; }
  /// For additions to the report after validation.
  FileReport& report() { return report_; }
  /// Whether the report has all errors and warnings of a validation with default options.
  bool validated_by_default() const { return by_default_; }
  /// Attaches a proposed fix to a finding, given by its index in the report.
  void propose(std::size_t finding, std::shared_ptr<const ProposedFix> fix) {
    report_.diagnostics[finding].fix = std::move(fix);
  }

  /// Frees the memory of tables that may be large.
  void forget_views() { asset_.forget_views(); }
  void forget_large_document() { asset_.forget_large_document(); }
  /// Frees the parts of the report other than findings.
  void forget_info() { report_.info.reset(); }
  /// Moves the report out, when nothing else is needed any more.
  FileReport take_report() { return std::move(report_); }
  model::OpenedAsset take_asset() { return std::move(asset_); }

 private:
  model::OpenedAsset asset_;
  Sites sites_;
  FileReport report_;
  bool by_default_;
};

/// Default options for one of many files.
ValidateOptions default_validation(const std::shared_ptr<const schema::Set>& schemas);

}  // namespace gltfx::validate

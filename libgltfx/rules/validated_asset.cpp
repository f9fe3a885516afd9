// SPDX-License-Identifier: Apache-2.0
#include "rules/validated_asset.hpp"

#include "rules/validator.hpp"

namespace gltfx::validate {
namespace {

// Lists all members, so that a new member of the options does not compile until it is handled here.
bool validates_by_default(const ValidateOptions& options) {
  const auto& [profile, pixels, limits, products, lfs, inline_suppressions, root, searched,
               max_issues, changed_lines, changed_lines_of, propose_fixes, targets, jobs, select,
               ignore, severity, schemas, own_rules, cache] = options;
  // The root and the schemas depend on the asset, not on preferences.
  static_cast<void>(root);
  static_cast<void>(searched);
  static_cast<void>(products);
  static_cast<void>(schemas);
  static_cast<void>(propose_fixes);
  static_cast<void>(jobs);
  static_cast<void>(cache);
  return profile == Profile::standard &&
         pixels.value_or(PixelLevel::headers) == PixelLevel::headers && limits.empty() &&
         lfs == LfsPolicy::skip && !inline_suppressions && targets.empty() && max_issues == 0 &&
         !changed_lines && !changed_lines_of && select.empty() && ignore.empty() &&
         severity.empty() && own_rules == nullptr;
}

}  // namespace

ValidatedAsset::ValidatedAsset(model::OpenedAsset asset, const ValidateOptions& options,
                               SharedReports* shared)
    : asset_(std::move(asset)),
      report_(validate(asset_, options, &sites_, nullptr, shared)),
      by_default_(validates_by_default(options)) {}

ValidatedAsset::ValidatedAsset(model::OpenedAsset asset, FileReport report,
                               const ValidateOptions& options)
    : asset_(std::move(asset)),
      report_(std::move(report)),
      by_default_(validates_by_default(options)) {}

ValidateOptions default_validation(const std::shared_ptr<const schema::Set>& schemas) {
  ValidateOptions options;
  options.jobs = 1;
  options.schemas = schemas;
  return options;
}

}  // namespace gltfx::validate

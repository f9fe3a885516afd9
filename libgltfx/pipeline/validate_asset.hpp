// SPDX-License-Identifier: Apache-2.0
/// Validation for verbs that go on with the asset.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <optional>
#include <string>

#include "model/opened_asset.hpp"
#include "validate/validated_asset.hpp"

namespace gltfx {

/// As validate_bytes(), of what was opened: fixes are proposed where the options ask for them.
validate::ValidatedAsset validate_asset(model::OpenedAsset asset, const ValidateOptions& options);

/// A report, and the asset where it had to be opened.
struct Validation {
  FileReport report;
  std::optional<model::OpenedAsset> asset;  ///< nothing: unreadable, or the report was kept
};

/// As validate_file(), which gives the report alone.
Validation validate_path(const std::string& path, const ValidateOptions& options);

}  // namespace gltfx

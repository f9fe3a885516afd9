// SPDX-License-Identifier: Apache-2.0
/// The phases of validation in their order, over one opened asset.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <string>

#include "model/opened_asset.hpp"
#include "rules/fix_entry.hpp"

namespace gltfx::validate {

/// Runs every phase that can run; each collects and none stops the next, unless what it would look
/// at does not exist. The asset's name stands in the report, and its ending says which container
/// was promised. The asset keeps the tables that were made of its document.
/// `sites`, where it is not null, gets what findings with a fix mark.
FileReport validate(model::OpenedAsset& asset, const ValidateOptions& options,
                    Sites* sites = nullptr);

/// The report on a file that could not be opened.
FileReport unreadable(const std::string& name, const std::string& reason,
                      const ValidateOptions& options);

}  // namespace gltfx::validate

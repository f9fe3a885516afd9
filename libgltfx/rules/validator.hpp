// SPDX-License-Identifier: Apache-2.0
/// The phases of validation in their order, over one opened asset.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <string>
#include <vector>

#include "model/opened_asset.hpp"
#include "rules/fix_entry.hpp"
#include "rules/shortfall.hpp"

namespace gltfx::validate {

class SharedReports;

/// Runs all phases; a phase with findings does not stop the next, unless the input of that does not
/// exist. The asset's name appears in the report, and its file extension gives the expected
/// container. The asset keeps the tables that are made of its document. `sites`, if it is not null,
/// gets the places of findings with a fix, `shortfalls` what the targets of the options lack;
/// `shared`, likewise, has the reports on external assets that are made already.
FileReport validate(model::OpenedAsset& asset, const ValidateOptions& options,
                    Sites* sites = nullptr, std::vector<Shortfall>* shortfalls = nullptr,
                    SharedReports* shared = nullptr);

/// The report on a file that could not be opened.
FileReport unreadable(const std::string& name, const std::string& reason,
                      const ValidateOptions& options);

}  // namespace gltfx::validate

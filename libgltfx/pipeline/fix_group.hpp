// SPDX-License-Identifier: Apache-2.0
/// Fixes assets that share files: all corrections of a file become one new content of it, and only
/// those are made that suit everybody who reads the same bytes.
#pragma once

#include <gltfx/fix.hpp>

#include <memory>
#include <optional>
#include <vector>

#include "pipeline/edit_asset.hpp"
#include "pipeline/named_files.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// What a run has for all of its groups.
struct FixRun {
  const FixOptions& options;  ///< without output
  std::shared_ptr<const schema::Set> schemas;
  unsigned jobs = 1;
  FolderIndex folders;
};

/// Fixes assets and writes what is to be written. Reports by position.
std::vector<FixReport> fix_group(const std::vector<EditInput>& assets, FixRun& run);

/// Fixes an asset in memory. The draft; nothing where the asset stays.
std::optional<Draft> fix_in_memory(EditedAsset asset, FixRun& run, FixReport& report);

}  // namespace gltfx

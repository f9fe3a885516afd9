// SPDX-License-Identifier: Apache-2.0
/// Files that a conversion must not replace.
#pragma once

#include <gltfx/convert.hpp>

#include <optional>
#include <string>
#include <vector>

#include "change/change.hpp"
#include "model/opened_asset.hpp"
#include "pipeline/named_files.hpp"

namespace gltfx {

/// Why a new file would take the place of another one, or nothing.
std::optional<std::string> find_taken_name(const model::OpenedAsset& before,
                                           const ConvertOptions& options,
                                           const std::vector<change::NewFile>& files);

/// In place: why another asset may read the bytes of a file that changes, or nothing.
std::optional<std::string> find_other_reader(const model::OpenedAsset& before,
                                             const ConvertOptions& options,
                                             const std::vector<change::ReplacedFile>& files,
                                             FolderIndex& folders);

}  // namespace gltfx

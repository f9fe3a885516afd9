// SPDX-License-Identifier: Apache-2.0
/// How every verb opens a file.
#pragma once

#include <optional>
#include <string>

#include "base/result.hpp"
#include "model/opened_asset.hpp"

namespace gltfx {

/// Opens, reads nothing of it yet. `root` as in ValidateOptions.
Result<model::OpenedAsset> open_asset(const std::string& path, const std::string& root);

/// Why nothing but a report can be made of the asset, as half a sentence: its container has no text
/// of a document, or nothing can be made of that text. Nothing when something can.
std::optional<Error> find_obstacle(const model::OpenedAsset& asset);

/// Both: the Error is that of either.
Result<model::OpenedAsset> open_document(const std::string& path, const std::string& root);

}  // namespace gltfx

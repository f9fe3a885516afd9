// SPDX-License-Identifier: Apache-2.0
/// How every verb opens a file, and where its references may lead.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "container/resolver.hpp"
#include "model/opened_asset.hpp"

namespace gltfx {

/// Opens, reads nothing of it yet. `root` as in ValidateOptions.
Result<model::OpenedAsset> open_asset(const std::string& path, const std::string& root);

/// Why nothing but a report can be made of the asset, as half a sentence: its container has no text
/// of a document, or nothing can be made of that text. Nothing when something can.
std::optional<Error> find_obstacle(const model::OpenedAsset& asset);

/// Both: the Error is that of either.
Result<model::OpenedAsset> open_document(const std::string& path, const std::string& root);

/// The asset's folder is the base of its references; the root of trust is that folder or a wider
/// one that the user named.
inline container::Resolver resolver_for(const std::filesystem::path& folder,
                                        const std::string& root) {
  const std::filesystem::path base = folder.empty() ? std::filesystem::path(".") : folder;
  return {root.empty() ? base : std::filesystem::path(root), base};
}

}  // namespace gltfx

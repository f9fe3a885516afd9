// SPDX-License-Identifier: Apache-2.0
/// Files that an asset refers to, for writing it to another folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "container/resolver.hpp"
#include "json/document.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::change {

/// The files that a document refers to, relative to its folder, in the form of
/// container::Uri::path: members called "uri" or "...Uri", such as "schemaUri", also in extensions,
/// with backslashes turned into slashes. Extras are left out.
std::set<std::string> referred_paths(const json::Document& document);

/// The same by the value that names them.
std::map<json::NodeId, std::string> referred_files(const json::Document& document);

/// The files that external assets of an asset refer to, at any depth, relative to its folder,
/// without those that an alias replaces.
std::set<std::string> paths_of_external_assets(const model::OpenedAsset& asset);

/// Makes a folder and its missing parents.
std::optional<Error> make_folder(const std::filesystem::path& folder);

/// Whether a regular file exists and consists of these pieces.
bool has_bytes(const std::filesystem::path& file, const std::vector<container::Bytes>& pieces);

/// Creates a file, whole and durable, unless it exists with the same bytes; another run may be
/// writing it now. A file with other bytes is not overwritten.
std::optional<Error> put_file(const std::filesystem::path& target,
                              const std::vector<container::Bytes>& pieces);

/// Copies files below `folder`, under the names by which a document refers to them. An existing
/// file with the same bytes stays; one with other bytes is not overwritten. References to missing
/// files are skipped: they are broken before and after.
std::optional<Error> copy_companions(const std::set<std::string>& paths,
                                     const container::Resolver& resolver,
                                     const std::filesystem::path& folder);

}  // namespace gltfx::change

// SPDX-License-Identifier: Apache-2.0
/// @file
/// Folders that were searched for assets. Their contents are not trusted: an asset that was found
/// must not be a link to a file elsewhere.
#pragma once

#include <functional>
#include <set>
#include <string>

namespace gltfx {

/// The first part of the paths of assets below them, with or without the last '/'; an empty one is
/// the working folder for relative paths.
using SearchedFolders = std::set<std::string, std::less<>>;

}  // namespace gltfx

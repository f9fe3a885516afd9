// SPDX-License-Identifier: Apache-2.0
/// What the user named, as the list of inputs to open.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// Inputs in the order they are reported: that of the arguments, sorted within a folder or glob.
struct Inputs {
  /// Each once; "-" is standard input. A path that does not exist stays in the list, so that
  /// opening it says why it cannot be read.
  std::vector<std::string> paths;
  /// By path: where it stands below the folder that was named, or its name when it was named
  /// itself.
  std::vector<std::string> places;
  /// Folders among the arguments, and among what globs gave.
  std::vector<std::string> folders;
  bool several = false;  ///< what was named may be more than one file: a folder, a glob, two files
  /// Sentences about arguments that name nothing to check.
  std::vector<std::string> notes;
};

/// Folders are searched through for .gltf and .glb files (in any case of letters); folders that
/// are symbolic links are entered only when named, `.git` never. Notes go to standard error unless
/// `quiet`.
Inputs expand_paths(const NamedPaths& named, bool quiet);

/// Why `root` cannot be what --root names, or nothing; empty is no root at all.
std::optional<Error> check_root(const std::string& root);

/// Whether a path ends in .gltf or .glb, in any case of letters.
bool is_asset_name(const std::string& path);

}  // namespace gltfx::tool

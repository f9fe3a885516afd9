// SPDX-License-Identifier: Apache-2.0
/// What the user named, as the list of inputs to open.
#pragma once

#include <string>
#include <vector>

namespace gltfx::tool {

/// Inputs in the order they are reported: that of the arguments, sorted within a folder or glob.
struct Inputs {
  /// Each once; "-" is standard input. A path that does not exist stays in the list, so that
  /// opening it says why it cannot be read.
  std::vector<std::string> paths;
  /// Sentences about arguments that name nothing to check.
  std::vector<std::string> notes;
};

/// Folders are searched through for .gltf and .glb files (in any case of letters); folders that
/// are symbolic links are entered only when named, `.git` never.
Inputs expand_paths(const std::vector<std::string>& arguments);

}  // namespace gltfx::tool

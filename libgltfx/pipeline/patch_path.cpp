// SPDX-License-Identifier: Apache-2.0
#include "pipeline/patch_path.hpp"

#include <system_error>

namespace gltfx {

namespace fs = std::filesystem;

std::string patch_path(const fs::path& path) {
  std::error_code fault;
  const fs::path here = fs::canonical(".", fault);
  const fs::path file = fault ? fs::path() : fs::canonical(path, fault);
  const fs::path below = fault ? fs::path() : file.lexically_relative(here);
  if (!below.empty() && *below.begin() != "..") return below.native();
  return path.lexically_normal().relative_path().native();
}

}  // namespace gltfx

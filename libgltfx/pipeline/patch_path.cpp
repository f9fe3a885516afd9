// SPDX-License-Identifier: Apache-2.0
#include "pipeline/patch_path.hpp"

#include <system_error>

namespace gltfx {

namespace fs = std::filesystem;

std::string patch_path(const fs::path& path) {
  std::error_code error;
  const fs::path here = fs::canonical(".", error);
  const fs::path file = error ? fs::path() : fs::canonical(path, error);
  const fs::path below = error ? fs::path() : file.lexically_relative(here);
  if (!below.empty() && *below.begin() != "..") return below.native();
  return path.lexically_normal().relative_path().native();
}

}  // namespace gltfx

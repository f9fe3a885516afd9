// SPDX-License-Identifier: Apache-2.0
#include "repository.hpp"

#include <system_error>

namespace gltfx::tool {

namespace fs = std::filesystem;

fs::path repository_of(const fs::path& folder) {
  std::error_code error;
  for (fs::path at = folder; !at.empty(); at = at.parent_path()) {
    if (fs::exists(at / ".git", error)) return at;
    if (at == at.root_path()) break;
  }
  return {};
}

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
#include <gltfx/limit.hpp>

#include <filesystem>
#include <system_error>

namespace gltfx {

const ProductSize& ProductList::find(std::string_view path) const {
  namespace fs = std::filesystem;
  if (!by_path.empty()) {
    std::error_code error;
    const auto found = by_path.find(fs::absolute(path, error).lexically_normal().native());
    if (found != by_path.end()) return found->second;
  }
  const auto found = by_name.find(path.substr(path.find_last_of('/') + 1));
  return found != by_name.end() ? found->second : others;
}

}  // namespace gltfx

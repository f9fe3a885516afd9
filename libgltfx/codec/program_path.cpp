// SPDX-License-Identifier: Apache-2.0
#include "codec/program_path.hpp"

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <unistd.h>

namespace gltfx::codec {
namespace {

namespace fs = std::filesystem;

bool is_program(const std::string& path) { return ::access(path.c_str(), X_OK) == 0; }

// Texts, not paths: where memory is missing, libstdc++ may lose count of what a path is made of.
std::string joined(std::string folder, std::string_view name) {
  return folder.append("/").append(name);
}

}  // namespace

std::string program_path(const std::string& folder, const std::string& name) {
  if (!folder.empty()) return joined(folder, name);
  // Nothing here changes the environment.
  const char* named = std::getenv("GLTFX_CODEC_WORKERS");  // NOLINT(concurrency-mt-unsafe)
  if (named != nullptr && *named != '\0') return joined(named, name);
  std::error_code fault;
  const std::string own = fs::read_symlink("/proc/self/exe", fault).parent_path().native();
  for (const char* way : {".", GLTFX_WORKERS_FROM_PROGRAMS}) {
    std::string path = joined(joined(own, way), name);
    if (is_program(path)) return path;
  }
  return joined(GLTFX_WORKER_FOLDER, name);
}

}  // namespace gltfx::codec

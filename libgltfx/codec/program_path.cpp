// SPDX-License-Identifier: Apache-2.0
#include "codec/program_path.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace gltfx::codec {
namespace {

namespace fs = std::filesystem;

bool is_program(const fs::path& path) { return ::access(path.c_str(), X_OK) == 0; }

}  // namespace

std::string program_path(const std::string& folder, const std::string& name) {
  if (!folder.empty()) return fs::path(folder) / name;
  // Nothing here changes the environment.
  const char* named = std::getenv("GLTFX_CODEC_WORKERS");  // NOLINT(concurrency-mt-unsafe)
  if (named != nullptr && *named != '\0') return fs::path(named) / name;
  std::error_code fault;
  const fs::path own = fs::read_symlink("/proc/self/exe", fault).parent_path();
  for (const char* way : {"", GLTFX_WORKERS_FROM_PROGRAMS}) {
    const fs::path path = (own / way / name).lexically_normal();
    if (is_program(path)) return path;
  }
  return fs::path(GLTFX_WORKER_FOLDER) / name;
}

}  // namespace gltfx::codec

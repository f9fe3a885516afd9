// SPDX-License-Identifier: Apache-2.0
#include "codec/program_path.hpp"

#include <gltfx/decoders.hpp>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string_view>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "base/fork.hpp"

namespace gltfx {
namespace {

ForkMutex folder_mutex;
// Not destroyed: decoding at the end of the program may use it.
std::string* chosen_folder = nullptr;

// Set before main(), possibly before other variables of this file.
std::atomic<const char*> package_header = nullptr;

}  // namespace

void set_codec_folder(const std::string& folder) {
  const std::lock_guard lock(folder_mutex);
  if (chosen_folder == nullptr) {
    chosen_folder = new std::string;  // NOLINT(cppcoreguidelines-owning-memory)
  }
  *chosen_folder = folder;
}

// Declared for programs that are built against a package.
namespace detail {
void set_package_header(const char* path);
void set_package_header(const char* path) { package_header = path; }
}  // namespace detail

namespace codec {
namespace {

namespace fs = std::filesystem;

std::string codec_folder() {
  const std::lock_guard lock(folder_mutex);
  return chosen_folder == nullptr ? std::string() : *chosen_folder;
}

// Strings, not paths: libstdc++ can corrupt a path if memory is missing.
std::string joined(std::string folder, std::string_view name) {
  return folder.append("/").append(name);
}

// The folder of the headers that the program was built against. A relative path would be wrong in
// another working folder.
std::string package_folder() {
  const char* header = package_header;
  if (header == nullptr || *header != '/') return {};
  const std::string_view path = header;
  return joined(std::string(path.substr(0, path.rfind('/'))), GLTFX_WORKERS_FROM_HEADERS);
}

}  // namespace

bool is_program(const std::string& path) { return ::access(path.c_str(), X_OK) == 0; }

std::string program_path(const std::string& folder, const std::string& name) {
  if (!folder.empty()) return joined(folder, name);
  // Nothing here changes the environment.
  const char* named = std::getenv("GLTFX_CODEC_WORKERS");  // NOLINT(concurrency-mt-unsafe)
  if (named != nullptr && *named != '\0') return joined(named, name);
  if (std::string chosen = codec_folder(); !chosen.empty()) return joined(std::move(chosen), name);
  std::error_code error;
  const std::string own = fs::read_symlink("/proc/self/exe", error).parent_path().native();
  for (const char* way : {".", GLTFX_WORKERS_FROM_PROGRAMS}) {
    std::string path = joined(joined(own, way), name);
    if (is_program(path)) return path;
  }
  if (const std::string package = package_folder(); !package.empty()) {
    std::string path = joined(package, name);
    if (is_program(path)) return path;
  }
  return joined(GLTFX_WORKER_FOLDER, name);
}

}  // namespace codec
}  // namespace gltfx

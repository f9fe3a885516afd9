// SPDX-License-Identifier: Apache-2.0
#include "glob.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <unordered_set>
#include <utility>

#include <fnmatch.h>

#include "base/directory.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

fs::path or_here(const fs::path& folder) { return folder.empty() ? fs::path(".") : folder; }

std::vector<fs::path> names_in(const fs::path& folder) {
  std::vector<fs::path> names;
  DirectoryReader directory(folder);
  while (const char* name = directory.next()) names.emplace_back(name);
  return names;
}

bool is_real_folder(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() == fs::file_type::directory;
}

// The folders and every folder below them, each once.
std::vector<fs::path> folders_below(std::vector<fs::path> folders) {
  std::unordered_set<std::string> known;
  for (const fs::path& folder : folders) known.insert(folder.native());
  for (std::size_t i = 0; i < folders.size(); ++i) {
    for (const fs::path& name : names_in(folders[i])) {
      fs::path path = folders[i] / name;
      if (name.native().front() == '.' || !is_real_folder(path)) continue;
      if (known.insert(path.native()).second) folders.push_back(std::move(path));
    }
  }
  return folders;
}

// What one step of the pattern finds below one folder.
std::vector<fs::path> step_into(const fs::path& folder, const std::string& step) {
  std::vector<fs::path> found;
  if (!is_glob(step)) {
    std::error_code error;
    if (fs::exists(or_here(folder / step), error)) found.push_back(folder / step);
    return found;
  }
  for (const fs::path& name : names_in(folder)) {
    if (::fnmatch(step.c_str(), name.c_str(), FNM_PERIOD) == 0) found.push_back(folder / name);
  }
  return found;
}

}  // namespace

bool is_glob(std::string_view path) { return path.find_first_of("*?[") != std::string_view::npos; }

std::vector<std::string> expand_glob(const std::string& pattern) {
  std::vector<fs::path> found{fs::path()};
  for (const fs::path& step : fs::path(pattern)) {
    if (step == "**") {
      found = folders_below(std::move(found));
      continue;
    }
    std::vector<fs::path> next;
    for (const fs::path& folder : found) {
      const std::vector<fs::path> deeper = step_into(folder, step.native());
      next.insert(next.end(), deeper.begin(), deeper.end());
    }
    found = std::move(next);
  }
  std::vector<std::string> paths;
  for (const fs::path& path : found) {
    if (!path.empty()) paths.push_back(path.native());
  }
  std::sort(paths.begin(), paths.end());
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  return paths;
}

}  // namespace gltfx::tool

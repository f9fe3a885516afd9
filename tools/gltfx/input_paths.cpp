// SPDX-License-Identifier: Apache-2.0
#include "input_paths.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <unordered_set>

#include "base/text.hpp"
#include "glob.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

bool is_asset(const fs::path& path) {
  std::string ending = path.extension().native();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending == ".gltf" || ending == ".glb";
}

// Regular files and links to them; whatever else is called so (a pipe, a folder) is no asset.
bool is_file(const fs::directory_entry& entry) {
  std::error_code fault;
  return entry.is_regular_file(fault);
}

bool is_real_folder(const fs::directory_entry& entry) {
  std::error_code fault;
  return !entry.is_symlink(fault) && entry.is_directory(fault);
}

// Adds the assets of one folder and queues the folders in it. A folder that cannot be listed is
// added itself: opening it will say so.
void list_folder(const fs::path& folder, std::vector<std::string>& assets,
                 std::vector<fs::path>& folders) {
  std::error_code fault;
  fs::directory_iterator at(folder, fault);
  for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
    if (is_real_folder(*at)) {
      if (at->path().filename() != ".git") folders.push_back(at->path());
    } else if (is_asset(at->path()) && is_file(*at)) {
      assets.push_back(at->path().native());
    }
  }
  if (fault) assets.push_back(folder.native());
}

std::vector<std::string> assets_below(const fs::path& folder) {
  std::vector<std::string> assets;
  std::vector<fs::path> folders{folder};
  while (!folders.empty()) {
    const fs::path next = std::move(folders.back());
    folders.pop_back();
    list_folder(next, assets, folders);
  }
  std::sort(assets.begin(), assets.end());
  return assets;
}

class Expansion {
 public:
  void add(const std::string& argument) {
    std::error_code fault;
    if (argument == "-" || fs::exists(argument, fault) || !is_glob(argument)) {
      add_path(argument);
      return;
    }
    const std::vector<std::string> matches = expand_glob(argument);
    if (matches.empty()) keep(argument);
    for (const std::string& match : matches) add_path(match);
  }
  Inputs finish() { return std::move(inputs_); }

 private:
  void add_path(const std::string& path) {
    std::error_code fault;
    if (path == "-" || !fs::is_directory(path, fault)) {
      keep(path);
      return;
    }
    const std::vector<std::string> assets = assets_below(path);
    if (assets.empty()) {
      inputs_.notes.push_back("folder " + quoted(path, 200) + " holds no .gltf or .glb file");
    }
    for (const std::string& asset : assets) keep(asset);
  }
  void keep(const std::string& path) {
    const std::string same = path == "-" ? path : fs::path(path).lexically_normal().native();
    if (seen_.insert(same).second) inputs_.paths.push_back(path);
  }

  Inputs inputs_;
  std::unordered_set<std::string> seen_;
};

}  // namespace

Inputs expand_paths(const std::vector<std::string>& arguments) {
  Expansion expansion;
  for (const std::string& argument : arguments) expansion.add(argument);
  return expansion.finish();
}

}  // namespace gltfx::tool

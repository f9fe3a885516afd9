// SPDX-License-Identifier: Apache-2.0
#include "input_paths.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <unordered_set>

#include "base/text.hpp"
#include "commands.hpp"
#include "glob.hpp"
#include "json/token.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

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
    } else if (is_asset_name(at->path().native()) && is_file(*at)) {
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
    inputs_.several = true;
    const std::vector<std::string> matches = expand_glob(argument);
    if (matches.empty()) keep(argument);
    for (const std::string& match : matches) add_path(match);
  }
  void keep(const std::string& path) { keep(path, fs::path(path).filename().native()); }
  Inputs finish() {
    inputs_.several = inputs_.several || inputs_.paths.size() > 1;
    return std::move(inputs_);
  }

 private:
  void add_path(const std::string& path) {
    std::error_code fault;
    if (path == "-" || !fs::is_directory(path, fault)) {
      keep(path);
      return;
    }
    inputs_.several = true;
    inputs_.folders.push_back(path);
    const std::vector<std::string> assets = assets_below(path);
    if (assets.empty()) {
      inputs_.notes.push_back("folder " + quoted(path, 200) + " holds no .gltf or .glb file");
    }
    for (const std::string& asset : assets) {
      keep(asset, fs::path(asset).lexically_relative(path).native());
    }
  }
  void keep(const std::string& path, const std::string& place) {
    const std::string same = path == "-" ? path : fs::path(path).lexically_normal().native();
    if (!seen_.insert(same).second) return;
    inputs_.paths.push_back(path);
    inputs_.places.push_back(place);
  }

  Inputs inputs_;
  std::unordered_set<std::string> seen_;
};

}  // namespace

bool is_asset_name(const std::string& path) {
  const std::string ending = json::lower_case(fs::path(path).extension().native());
  return ending == ".gltf" || ending == ".glb";
}

Inputs expand_paths(const NamedPaths& named, bool quiet) {
  Expansion expansion;
  for (const std::string& word : named.words) {
    if (named.literal) {
      expansion.keep(word);
    } else {
      expansion.add(word);
    }
  }
  Inputs inputs = expansion.finish();
  if (quiet) return inputs;
  for (const std::string& note : inputs.notes) complain("note: " + note);
  return inputs;
}

std::optional<Error> check_root(const std::string& root) {
  std::error_code fault;
  if (root.empty() || fs::is_directory(root, fault)) return std::nullopt;
  return Error{"--root: " + quoted(root, 200) + " is not a folder"};
}

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
#include "folder_walk.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/directory.hpp"
#include "base/text.hpp"
#include "path_pattern.hpp"

namespace gltfx::tool {

namespace fs = std::filesystem;

bool is_asset_name(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".gltf" || ending == ".glb";
}

FolderWalk::FolderWalk(const NamedPaths& named) : named_(named) {
  std::error_code error;
  working_folder_ = fs::current_path(error).native();
}

bool FolderWalk::enter(const std::string& folder) {
  root_length_ = folder.size() + (folder.ends_with('/') ? 0 : 1);
  if (!named_.no_ignore) ignore_files_.begin(folder);
  return list(folder);
}

std::optional<FoundFile> FolderWalk::next() {
  Listing& listing = open_.back();
  if (listing.order.empty()) {
    open_.pop_back();
    if (!named_.no_ignore) ignore_files_.leave();
    return std::nullopt;
  }
  std::string path = listing.path + (listing.names.data() + listing.order.back());
  listing.order.pop_back();
  if (path.ends_with('/')) {
    path.pop_back();
    if (list(path)) return std::nullopt;
  }
  std::string place = path.substr(std::min(root_length_, path.size()));
  return FoundFile{std::move(path), std::move(place)};
}

bool FolderWalk::is_excluded(std::string_view path, std::string_view place) const {
  if (named_.exclude.empty()) return false;
  fs::path normal = fs::path(path).lexically_normal();
  if (normal.is_absolute()) normal = normal.lexically_proximate(working_folder_);
  const std::string& plain = normal.native();
  return std::any_of(named_.exclude.begin(), named_.exclude.end(), [&](const std::string& each) {
    return fits_pattern(each, place) || fits_pattern(each, plain);
  });
}

bool FolderWalk::is_left_out(const std::string& path, bool is_folder) {
  const auto place = std::string_view(path).substr(std::min(root_length_, path.size()));
  // A pattern that ends in '/' fits what lies below: the folder need not be entered.
  if (is_excluded(path, place) ||
      (is_folder && is_excluded(path + "/x", std::string(place) + "/x")))
    return true;
  if (named_.no_ignore || !ignore_files_.ignores(path, is_folder)) return false;
  if (!is_folder) ++ignored_;
  return true;
}

// The assets and folders of one folder. False when it cannot be listed.
bool FolderWalk::list(const std::string& folder) {
  Listing listing{folder, {}, {}};
  if (!listing.path.ends_with('/')) listing.path += '/';
  if (!named_.no_ignore) ignore_files_.enter(listing.path);
  DirectoryReader directory(folder);
  while (const char* entry = directory.next()) {
    const std::string name = entry;
    const bool below = directory.is_directory() && name != ".git";
    if (!below && !(is_asset_name(name) && directory.is_file())) continue;
    if (is_left_out(listing.path + name, below)) continue;
    listing.order.push_back(static_cast<std::uint32_t>(listing.names.size()));
    listing.names.append(name).append(below ? "/" : "").push_back('\0');
  }
  const char* names = listing.names.data();
  std::sort(listing.order.begin(), listing.order.end(), [names](std::uint32_t a, std::uint32_t b) {
    return std::strcmp(names + a, names + b) > 0;
  });
  open_.push_back(std::move(listing));
  return !directory.error();
}

}  // namespace gltfx::tool

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
#include "read_input.hpp"
#include "repository.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// Real files have some dozens of lines; each costs time for each file.
constexpr std::size_t kMostPatterns = 2000;
constexpr std::size_t kLongestPattern = 400;
constexpr std::ptrdiff_t kMostStars = 16;

// From the top of the repository to the folder itself; empty outside of repositories.
std::vector<fs::path> folders_of_repository(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::canonical(folder, error);
  const fs::path top = repository_of(whole);
  if (top.empty()) return {};
  std::vector<fs::path> folders{top};
  for (const fs::path& name : whole.lexically_relative(top)) {
    if (name != ".") folders.push_back(folders.back() / name);
  }
  return folders;
}

}  // namespace

std::vector<IgnoreFiles::Pattern> IgnoreFiles::parse(std::string_view text) {
  std::vector<Pattern> patterns;
  while (!text.empty() && patterns.size() < kMostPatterns) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (line.ends_with('\r') || (line.ends_with(' ') && !line.ends_with("\\ "))) {
      line.remove_suffix(1);
    }
    Pattern pattern;
    if (line.starts_with('#')) continue;
    if (line.starts_with('!')) {
      pattern.keep = true;
      line.remove_prefix(1);
    }
    if (line.ends_with('/')) {
      pattern.folders_only = true;
      line.remove_suffix(1);
    }
    pattern.anchored = line.find('/') != std::string_view::npos;
    if (line.starts_with('/')) line.remove_prefix(1);
    const bool costly = std::count(line.begin(), line.end(), '*') > kMostStars;
    if (line.empty() || line.size() > kLongestPattern || costly) continue;
    pattern.text = line;
    patterns.push_back(std::move(pattern));
  }
  return patterns;
}

void IgnoreFiles::read(const std::string& folder, std::string before, std::size_t skip) {
  File file{std::move(before), skip, {}};
  std::error_code error;
  const std::string path = folder + ".gitignore";
  if (fs::is_regular_file(fs::symlink_status(path, error))) {
    if (const auto text = read_text_file(path, kLongestConfig)) file.patterns = parse(*text);
  }
  files_.push_back(std::move(file));
}

void IgnoreFiles::begin(const std::string& folder) {
  files_.clear();
  const std::vector<fs::path> folders = folders_of_repository(folder);
  in_repository_ = !folders.empty();
  const std::size_t skip = folder.size() + (folder.ends_with('/') ? 0 : 1);
  for (std::size_t i = 0; i + 1 < folders.size(); ++i) {
    const std::string before = folders.back().lexically_relative(folders[i]).native() + "/";
    read(folders[i].native() + "/", before, skip);
  }
}

void IgnoreFiles::enter(const std::string& folder) {
  if (in_repository_) read(folder, {}, folder.size());
}

void IgnoreFiles::leave() {
  if (in_repository_ && !files_.empty()) files_.pop_back();
}

// The last matching pattern in the nearest file with a match decides.
bool IgnoreFiles::ignores(std::string_view path, bool is_folder) const {
  for (auto file = files_.rbegin(); file != files_.rend(); ++file) {
    const std::string relative = file->before + std::string(path.substr(file->skip));
    const auto& patterns = file->patterns;
    const auto last = std::find_if(patterns.rbegin(), patterns.rend(), [&](const Pattern& each) {
      if (each.folders_only && !is_folder) return false;
      const bool name_only = each.text.find('/') == std::string::npos;
      if (each.anchored && name_only && relative.find('/') != std::string::npos) return false;
      return fits_pattern(each.text, relative);
    });
    if (last != patterns.rend()) return !last->keep;
  }
  return false;
}

namespace fs = std::filesystem;

bool is_asset_name(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".gltf" || ending == ".glb" || ending == ".vrm";
}

FolderWalk::FolderWalk(const NamedPaths& named) : named_(named) {
  std::error_code error;
  working_folder_ = fs::current_path(error).native();
}

bool FolderWalk::enter(const std::string& folder) {
  note_search(folder);
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
  // A pattern that ends in '/' matches everything below: the folder need not be entered.
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

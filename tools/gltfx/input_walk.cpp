// SPDX-License-Identifier: Apache-2.0
#include "input_walk.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <fnmatch.h>

#include "base/directory.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// Whether `path` has a wildcard in it.
bool is_glob(std::string_view path) { return path.find_first_of("*?[") != std::string_view::npos; }

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

// The matches of one step of the pattern below one folder.
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

// The folder of a pattern before its first wildcard, with which matching paths begin; it may be
// empty.
std::string folder_of_glob(const std::string& pattern) {
  fs::path folder;
  for (const fs::path& step : fs::path(pattern)) {
    if (is_glob(step.native())) break;
    folder /= step;
  }
  return folder.native();
}

// Existing paths that match, sorted by bytes. A wildcard does not match a leading dot, and '**'
// does not step into folders that are symbolic links or whose name begins with a dot.
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

namespace fs = std::filesystem;

// The place of a path from a list below the output folder.
std::string place_of_listed(const std::string& path) {
  const fs::path plain = fs::path(path).lexically_normal();
  const bool inside = plain.is_relative() && !plain.empty() && *plain.begin() != "..";
  return inside ? plain.native() : plain.filename().native();
}

}  // namespace

std::optional<std::string> WordList::next() {
  if (word_ < named_.words.size()) return named_.words[word_++];
  while (listed_ < named_.listed.size()) {
    const std::size_t end = std::min(named_.listed.find(between_, listed_), named_.listed.size());
    std::string line = named_.listed.substr(listed_, end - listed_);
    listed_ = end + 1;
    if (between_ == '\n' && line.ends_with('\r')) line.pop_back();
    if (!line.empty()) return line;
  }
  return std::nullopt;
}

InputWalk::InputWalk(const NamedPaths& named)
    : named_(named),
      words_(named),
      folder_(named),
      may_repeat_(named.words.size() != 1 || !named.listed.empty() || is_glob(named.words.front())),
      several_(!named.listed.empty()) {}

std::optional<Input> InputWalk::next() {
  while (auto input = next_of_all()) {
    if (input->ours) return input;
  }
  return std::nullopt;
}

std::optional<Input> InputWalk::next_of_all() {
  while (auto input = step()) {
    if (!input->path.empty()) return input;
  }
  return std::nullopt;
}

// An input, one with an empty path if there is none yet, or nothing at the end.
std::optional<Input> InputWalk::step() {
  if (!folder_.at_end()) {
    auto file = folder_.next();
    if (!file) return Input();
    const std::string key = file->place;
    return take(std::move(file->path), std::move(file->place), key);
  }
  if (!matches_.empty()) {
    const std::string match = std::move(matches_.back());
    matches_.pop_back();
    std::error_code error;
    const bool linked_folder = fs::is_symlink(match, error) && fs::is_directory(match, error);
    if (linked_folder || folder_.is_excluded(match, match)) return Input();
    return enter(match);
  }
  finish_word();
  const auto word = words_.next();
  if (!word) return std::nullopt;
  current_ = *word;
  found_any_ = false;
  if (named_.literal) return take(*word, fs::path(*word).filename().native(), *word);
  std::error_code error;
  const bool plain =
      words_.from_list() || *word == "-" || !is_glob(*word) || fs::exists(*word, error);
  if (plain) return enter(*word);
  several_ = true;
  folder_.note_search(folder_of_glob(*word));
  matches_ = expand_glob(*word);
  std::reverse(matches_.begin(), matches_.end());
  if (!matches_.empty() || named_.allow_empty) return Input();
  auto unmatched = take(*word, fs::path(*word).filename().native(), *word);
  unmatched->unmatched = true;
  found_any_ = false;
  return unmatched;
}

void InputWalk::finish_word() {
  if (!found_any_) without_assets_.push_back(std::move(current_));
  found_any_ = true;
}

std::optional<Input> InputWalk::enter(const std::string& path) {
  std::error_code error;
  if (path == "-" || !fs::is_directory(path, error)) {
    return take(path,
                words_.from_list() ? place_of_listed(path) : fs::path(path).filename().native(),
                path);
  }
  several_ = true;
  folders_.push_back(path);
  if (!folder_.enter(path)) return take(path, fs::path(path).filename().native(), path);
  return Input();
}

// `key` decides the shard of the file: its place below a named folder, independent of the place of
// that folder, else the name given.
std::optional<Input> InputWalk::take(std::string path, std::string place, const std::string& key) {
  const auto plain = [](const std::string& name) {
    return name == "-" ? name : fs::path(name).lexically_normal().native();
  };
  found_any_ = true;
  if (may_repeat_ && !seen_.insert(hash_bytes(plain(path))).second) return Input();
  const std::uint64_t position = met_++;
  const Shard shard = named_.shard;
  const bool ours = shard.count <= 1 || hash_bytes(plain(key)).low % shard.count == shard.index - 1;
  return Input{std::move(path), std::move(place), position, ours};
}

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
#include "input_walk.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/text.hpp"
#include "glob.hpp"
#include "path_pattern.hpp"

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

// Where a path from a list lies below the folder that things are written to.
std::string place_of_listed(const std::string& path) {
  const fs::path plain = fs::path(path).lexically_normal();
  const bool inside = plain.is_relative() && !plain.empty() && *plain.begin() != "..";
  return inside ? plain.native() : plain.filename().native();
}

}  // namespace

bool is_asset_name(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".gltf" || ending == ".glb";
}

InputWalk::InputWalk(const NamedPaths& named)
    : named_(named),
      between_(named.listed.find('\0') != std::string::npos ? '\0' : '\n'),
      may_repeat_(named.words.size() != 1 || !named.listed.empty() || is_glob(named.words.front())),
      several_(!named.listed.empty()) {
  std::error_code fault;
  here_ = fs::current_path(fault).native();
}

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

// An input, one with an empty path where there is nothing to hand out yet, or nothing at the end.
std::optional<Input> InputWalk::step() {
  if (!open_.empty()) return step_into_folders();
  if (!matches_.empty()) {
    const std::string match = std::move(matches_.back());
    matches_.pop_back();
    return is_excluded(match, match) ? Input() : enter(match);
  }
  finish_word();
  const auto word = next_word();
  if (!word) return std::nullopt;
  current_ = *word;
  found_any_ = false;
  if (named_.literal) return take(*word, fs::path(*word).filename().native(), *word);
  std::error_code fault;
  const bool plain = listed_ > 0 || *word == "-" || !is_glob(*word) || fs::exists(*word, fault);
  if (plain) return enter(*word);
  several_ = true;
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

// Arguments, then the lines of the list, which are no patterns.
std::optional<std::string> InputWalk::next_word() {
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

std::optional<Input> InputWalk::enter(const std::string& path) {
  std::error_code fault;
  if (path == "-" || !fs::is_directory(path, fault)) {
    const bool listed = word_ == named_.words.size() && listed_ > 0;
    return take(path, listed ? place_of_listed(path) : fs::path(path).filename().native(), path);
  }
  several_ = true;
  folders_.push_back(path);
  root_length_ = path.size() + (path.ends_with('/') ? 0 : 1);
  if (!named_.no_ignore) ignore_files_.begin(path);
  if (!list(path)) return take(path, fs::path(path).filename().native(), path);
  return Input();
}

bool InputWalk::is_excluded(std::string_view path, std::string_view place) const {
  if (named_.exclude.empty()) return false;
  fs::path normal = fs::path(path).lexically_normal();
  if (normal.is_absolute()) normal = normal.lexically_proximate(here_);
  const std::string& plain = normal.native();
  return std::any_of(named_.exclude.begin(), named_.exclude.end(), [&](const std::string& each) {
    return fits_pattern(each, place) || fits_pattern(each, plain);
  });
}

bool InputWalk::is_left_out(const std::string& path, bool is_folder) {
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
bool InputWalk::list(const std::string& folder) {
  Listing listing{folder, {}, {}};
  if (!listing.path.ends_with('/')) listing.path += '/';
  if (!named_.no_ignore) ignore_files_.enter(listing.path);
  std::error_code fault;
  fs::directory_iterator at(folder, fault);
  for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
    const std::string name = at->path().filename().native();
    const bool below = is_real_folder(*at) && name != ".git";
    if (!below && !(is_asset_name(name) && is_file(*at))) continue;
    if (is_left_out(listing.path + name, below)) continue;
    listing.order.push_back(static_cast<std::uint32_t>(listing.names.size()));
    listing.names.append(name).append(below ? "/" : "").push_back('\0');
  }
  const char* names = listing.names.data();
  std::sort(listing.order.begin(), listing.order.end(), [names](std::uint32_t a, std::uint32_t b) {
    return std::strcmp(names + a, names + b) > 0;
  });
  open_.push_back(std::move(listing));
  return !fault;
}

std::optional<Input> InputWalk::step_into_folders() {
  Listing& listing = open_.back();
  if (listing.order.empty()) {
    open_.pop_back();
    if (!named_.no_ignore) ignore_files_.leave();
    return Input();
  }
  std::string path = listing.path + (listing.names.data() + listing.order.back());
  listing.order.pop_back();
  if (path.ends_with('/')) {
    path.pop_back();
    if (list(path)) return Input();
  }
  std::string place = path.substr(std::min(root_length_, path.size()));
  const std::string key = place;
  return take(std::move(path), std::move(place), key);
}

// `key` decides who takes the file: its place below a folder that was named, wherever that folder
// lies, else what was named.
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

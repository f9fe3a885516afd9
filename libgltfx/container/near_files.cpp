// SPDX-License-Identifier: Apache-2.0
#include "container/near_files.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "container/percent.hpp"

namespace gltfx::container {
namespace {

constexpr std::size_t kMostFolders = 64;

using Words = std::vector<std::string_view>;

Words split_path(std::string_view path) {
  Words names;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find_first_of("/\\", begin), path.size());
    const std::string_view name = path.substr(begin, end - begin);
    if (!name.empty() && name != "." && name != "..") names.push_back(name);
    begin = end + 1;
  }
  return names;
}

bool stays_inside(std::string_view path) {
  const bool drive = path.find(':') == 1;
  return !drive && !path.starts_with('/') && !path.starts_with('\\') && !path.starts_with("..");
}

std::string_view stem_of(std::string_view name) { return name.substr(0, name.rfind('.')); }

bool same_letters(std::string_view a, std::string_view b) { return lower_case(a) == lower_case(b); }

// Runs of letters and runs of digits, without other characters.
Words words_of(std::string_view text) {
  const auto kind = [](char c) {
    if (is_digit(c)) return 1;
    return is_alpha(c) || static_cast<unsigned char>(c) >= 0x80 ? 2 : 0;
  };
  Words words;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin + 1;
    while (end < text.size() && kind(text[end]) == kind(text[begin])) ++end;
    if (kind(text[begin]) != 0) words.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

// Numbers and short words distinguish files of a series: "wood_n" is not "wood_d".
bool is_misspelt(std::string_view wanted, std::string_view found) {
  constexpr std::size_t kShort = 4;
  if (wanted == found) return true;
  if (std::min(wanted.size(), found.size()) < kShort || is_digit(wanted.front())) return false;
  const std::array<std::string_view, 1> candidate{found};
  return !nearest(wanted, candidate).empty();
}

// "a.001" for "a", as modelling programs number copies.
bool is_numbered(std::string_view shorter, std::string_view longer) {
  if (longer.size() < shorter.size() + 2 || !longer.starts_with(shorter)) return false;
  const std::string_view rest = longer.substr(shorter.size());
  return rest.front() == '.' && std::all_of(rest.begin() + 1, rest.end(), is_digit);
}

bool is_spelt_alike(const std::string& wanted, const std::string& found) {
  const std::string a(stem_of(wanted));
  const std::string b(stem_of(found));
  if (ending_of(wanted) != ending_of(found)) return false;
  if (is_numbered(a, b) || is_numbered(b, a)) return true;
  const Words left = words_of(a);
  const Words right = words_of(b);
  return std::equal(left.begin(), left.end(), right.begin(), right.end(), is_misspelt);
}

/// Collects near files, each path once.
class Search {
 public:
  Search(const Resolver& resolver, std::string_view path)
      : resolver_(resolver), names_(split_path(path)), is_inside_(stays_inside(path)) {}

  std::vector<NearFile> run() {
    if (names_.empty()) return {};
    wanted_ = lower_case(names_.back());
    // The named folder, then the asset's own folder and those of the later steps of the path.
    for (std::size_t first = 0; first < names_.size(); ++first) {
      const std::string folder = find_folder(first);
      if (folder != kNoFolder) look_into(folder, first == 0 && is_inside_);
    }
    for (const std::string& folder : subfolders()) look_into(folder, false);
    std::sort(found_.begin(), found_.end(), [](const NearFile& a, const NearFile& b) {
      return std::tie(a.nearness, a.path) < std::tie(b.nearness, b.path);
    });
    return std::move(found_);
  }

 private:
  static constexpr std::string_view kNoFolder = "/";

  // The folder of the path from step `first` on, case-insensitive: empty or with a '/' at its end;
  // kNoFolder: there is none.
  std::string find_folder(std::size_t first) const {
    std::string folder;
    for (std::size_t i = first; i + 1 < names_.size(); ++i) {
      const auto entries = resolver_.list(folder);
      const FolderEntry* best = nullptr;
      for (const FolderEntry& entry : entries) {
        if (!entry.folder || !same_letters(entry.name, names_[i])) continue;
        if (best == nullptr || entry.name == names_[i]) best = &entry;
      }
      if (best == nullptr) return std::string(kNoFolder);
      folder += best->name + '/';
    }
    return folder;
  }

  std::vector<std::string> subfolders() const {
    std::vector<std::string> folders;
    for (const FolderEntry& entry : resolver_.list({})) {
      if (entry.folder && folders.size() < kMostFolders) folders.push_back(entry.name + '/');
    }
    return folders;
  }

  void look_into(const std::string& folder, bool named) {
    for (const FolderEntry& entry : resolver_.list(folder)) {
      if (entry.folder) continue;
      const std::string name = lower_case(entry.name);
      if (name == wanted_) {
        add(folder + entry.name, named ? Nearness::letter_case : Nearness::folder);
      } else if (named && stem_of(name) == stem_of(wanted_)) {
        add(folder + entry.name, Nearness::ending);
      } else if (named && is_spelt_alike(wanted_, name)) {
        add(folder + entry.name, Nearness::spelling);
      }
    }
  }

  void add(std::string path, Nearness nearness) {
    if (seen_.insert(path).second) found_.push_back({std::move(path), nearness});
  }

  const Resolver& resolver_;
  Words names_;
  bool is_inside_;
  std::string wanted_;  ///< the name of the file, in lower case
  std::set<std::string> seen_;
  std::vector<NearFile> found_;
};

}  // namespace

std::vector<NearFile> find_near_files(const Resolver& resolver, std::string_view path) {
  return Search(resolver, path).run();
}

std::string uri_of_path(std::string_view path) {
  std::string uri;
  const std::size_t first = std::min(path.find('/'), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const char c = path[i];
    const bool kept = is_path_character(c) || static_cast<unsigned char>(c) >= 0x80;
    if (kept && (c != ':' || i > first)) {
      uri += c;
    } else {
      append_escaped(uri, c);
    }
  }
  return uri;
}

}  // namespace gltfx::container

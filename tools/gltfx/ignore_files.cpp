// SPDX-License-Identifier: Apache-2.0
#include "ignore_files.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "path_pattern.hpp"
#include "read_input.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// What people write has some dozens of lines; each costs time for each file.
constexpr std::size_t kMostPatterns = 2000;
constexpr std::size_t kLongestPattern = 400;
constexpr std::ptrdiff_t kMostStars = 16;

// From the top of the repository to the folder itself; empty outside of repositories.
std::vector<fs::path> folders_of_repository(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::path at = fs::canonical(folder, error); !error; at = at.parent_path()) {
    folders.insert(folders.begin(), at);
    if (fs::exists(at / ".git", error)) return folders;
    if (at == at.root_path()) break;
  }
  return {};
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
  if (fs::is_regular_file(path, error)) {
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

// The last pattern that fits decides, in the file that is nearest and has one.
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

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
#include "source.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace gltfx::structure {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::string text(fs::file_size(path), '\0');
  std::ifstream(path, std::ios::binary)
      .read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

void add_file(std::vector<Source>& sources, const fs::path& path) {
  sources.push_back({fs::relative(path, repository()).generic_string(), read(path)});
}

}  // namespace

std::string repository() { return GLTFX_SOURCE_DIR; }

std::vector<Source> files_below(const std::vector<std::string>& roots) {
  std::vector<Source> sources;
  for (const std::string& name : roots) {
    const fs::path root = fs::path(repository()) / name;
    if (fs::is_regular_file(root)) add_file(sources, root);
    if (!fs::is_directory(root)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (entry.is_regular_file() && !entry.is_symlink()) add_file(sources, entry.path());
    }
  }
  std::sort(sources.begin(), sources.end(),
            [](const Source& a, const Source& b) { return a.path < b.path; });
  return sources;
}

std::vector<Source> cpp_below(const std::vector<std::string>& roots) {
  std::vector<Source> sources = files_below(roots);
  std::erase_if(sources, [](const Source& source) {
    return !source.path.ends_with(".cpp") && !source.path.ends_with(".hpp");
  });
  return sources;
}

std::vector<Include> includes_of(std::string_view text) {
  std::vector<Include> found;
  std::size_t line = 0;
  for (std::size_t at = 0; at < text.size();) {
    ++line;
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view row = text.substr(at, end - at);
    at = end + 1;
    constexpr std::string_view kStart = "#include ";
    if (!row.starts_with(kStart) || row.size() < kStart.size() + 3) continue;
    const bool angled = row[kStart.size()] == '<';
    const std::size_t close = row.find(angled ? '>' : '"', kStart.size() + 1);
    found.push_back(
        {line, std::string(row.substr(kStart.size() + 1, close - kStart.size() - 1)), angled});
  }
  return found;
}

std::size_t line_of(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::size_t line_count(std::string_view text) {
  const auto breaks = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  return breaks + (text.empty() || text.back() == '\n' ? 0 : 1);
}

std::string problem(const Source& source, std::size_t line, std::string_view why) {
  return source.path + ":" + std::to_string(line) + ": " + std::string(why);
}

bool starts_with_any(std::string_view text, const std::vector<std::string_view>& starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](std::string_view start) { return text.starts_with(start); });
}

}  // namespace gltfx::structure

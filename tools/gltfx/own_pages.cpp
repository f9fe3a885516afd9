// SPDX-License-Identifier: Apache-2.0
#include "own_pages.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "read_input.hpp"
#include "rules/own/own_rules.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

// The pages of a folder, or the file itself.
Result<std::vector<std::string>> page_files(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return std::vector<std::string>{path};
  auto files = files_in(path, ".md");
  if (!files) return files.error();
  // Says what a folder is for.
  std::erase_if(*files, [](const std::string& file) {
    return lower_case(fs::path(file).filename().native()) == "readme.md";
  });
  if (files->empty()) return Error{quoted(path, 200) + " holds no page named *.md"};
  return files;
}

}  // namespace

std::optional<Error> OwnPages::read(const std::vector<std::string>& paths) {
  std::vector<OwnRulePage> fresh;
  for (const std::string& path : paths) {
    if (files_.contains(path)) continue;
    auto files = page_files(path);
    if (!files) return files.error();
    for (std::string& file : *files) {
      file = fs::path(file).lexically_normal().native();
      // One page too many is a mistake; more of them need not be read.
      if (known_.size() > validate::kMostOwnPages || !known_.insert(file).second) continue;
      auto text = read_text_file(file, validate::kLongestOwnPage);
      if (!text) return text.error();
      fresh.push_back({file, *std::move(text)});
    }
    files_.emplace(path, *std::move(files));
  }
  if (fresh.empty()) return std::nullopt;
  std::sort(fresh.begin(), fresh.end(),
            [](const OwnRulePage& a, const OwnRulePage& b) { return a.file < b.file; });
  OwnRulesRead read = read_own_rules(fresh, all_.get());
  if (!read.mistakes.empty()) {
    return Error{
        fmt::format("the pages of rules have mistakes\n{}", fmt::join(read.mistakes, "\n"))};
  }
  all_ = std::move(read.rules);
  return std::nullopt;
}

std::shared_ptr<const OwnRules> OwnPages::of(const std::vector<std::string>& paths) const {
  std::set<std::string> files;
  for (const std::string& path : paths) {
    const auto found = files_.find(path);
    if (found != files_.end()) files.insert(found->second.begin(), found->second.end());
  }
  return files.size() == known_.size() || all_ == nullptr ? all_ : all_->of(files);
}

}  // namespace gltfx::tool

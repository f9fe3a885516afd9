// SPDX-License-Identifier: Apache-2.0
#include "own_pages.hpp"

#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "read_input.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLongestPage = std::uint64_t{1} << 20U;

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
  const std::size_t before = pages_.size();
  for (const std::string& path : paths) {
    if (files_.contains(path)) continue;
    auto files = page_files(path);
    if (!files) return files.error();
    for (std::string& file : *files) {
      file = fs::path(file).lexically_normal().native();
      if (pages_.contains(file)) continue;
      auto text = read_text_file(file, kLongestPage);
      if (!text) return text.error();
      pages_.emplace(file, OwnRulePage{file, *std::move(text)});
    }
    files_.emplace(path, *std::move(files));
  }
  if (pages_.size() == before) return std::nullopt;
  std::vector<OwnRulePage> pages;
  for (const auto& [file, page] : pages_) pages.push_back(page);
  OwnRulesRead read = read_own_rules(pages);
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
  if (files.size() == pages_.size()) return all_;
  std::vector<OwnRulePage> pages;
  for (const std::string& file : files) pages.push_back(pages_.at(file));
  return read_own_rules(pages).rules;
}

}  // namespace gltfx::tool

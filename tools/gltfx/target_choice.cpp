// SPDX-License-Identifier: Apache-2.0
#include "target_choice.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "read_input.hpp"
#include "target/choice.hpp"
#include "target/target_file.hpp"

namespace gltfx::tool {
namespace {

using Targets = std::vector<std::shared_ptr<const Target>>;

constexpr std::uint64_t kLongestTarget = std::uint64_t{16} << 20U;

Result<Targets> all_targets(const std::vector<std::string>& files) {
  Targets all = builtin_targets();
  for (const std::string& path : files) {
    const auto text = read_text_file(path, kLongestTarget);
    if (!text) return Error{"--target-file: " + text.error().message};
    auto read = target::read_target(*text);
    if (!read) {
      return Error{fmt::format("--target-file: {}: {}.", quoted(path, 200), read.error().message)};
    }
    std::erase_if(all, [&](const auto& one) { return one->name == read->name; });
    all.push_back(std::make_shared<const Target>(*std::move(read)));
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->name < b->name; });
  return all;
}

}  // namespace

Result<std::vector<TargetChoice>> read_targets(const std::vector<std::string>& words,
                                               const std::vector<std::string>& files) {
  std::vector<TargetChoice> choices;
  if (words.empty()) return choices;
  const auto all = all_targets(files);
  if (!all) return all.error();
  for (const std::string& list : words) {
    std::size_t begin = 0;
    while (begin <= list.size()) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      auto choice = target::choose(std::string_view(list).substr(begin, end - begin), *all);
      if (!choice) return Error{fmt::format("--target: {}.", choice.error().message)};
      choices.push_back(*std::move(choice));
      begin = end + 1;
    }
  }
  return choices;
}

std::vector<std::string> target_names(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  const auto all = all_targets(files);
  for (const auto& target : all ? *all : builtin_targets()) names.push_back(target->name);
  return names;
}

}  // namespace gltfx::tool

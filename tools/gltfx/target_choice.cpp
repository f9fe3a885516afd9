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
#include "target/builtin.hpp"
#include "target/choice.hpp"
#include "target/target_file.hpp"

namespace gltfx::tool {
namespace {

using Targets = std::vector<std::shared_ptr<const Target>>;

constexpr std::uint64_t kLongestTarget = std::uint64_t{16} << 20U;

// Targets of the user's own files.
Result<Targets> own_targets(const std::vector<std::string>& files) {
  Targets own;
  for (const std::string& path : files) {
    const auto text = read_text_file(path, kLongestTarget);
    if (!text) return Error{"--target-file: " + text.error().message};
    auto read = target::read_target(*text);
    if (!read) {
      return Error{fmt::format("--target-file: {}: {}.", quoted(path, 200), read.error().message)};
    }
    std::erase_if(own, [&](const auto& one) { return one->name == read->name; });
    own.push_back(std::make_shared<const Target>(*std::move(read)));
  }
  return own;
}

bool has(const Targets& targets, std::string_view name) {
  return std::any_of(targets.begin(), targets.end(),
                     [&](const auto& one) { return one->name == name; });
}

// Sorted by name.
Targets with_builtin(const Targets& own) {
  Targets all = own;
  for (const auto& one : builtin_targets()) {
    if (!has(own, one->name)) all.push_back(one);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->name < b->name; });
  return all;
}

// Only named built-in targets are read; all of them if a message must list them.
Result<TargetChoice> choose(std::string_view word, Targets& known) {
  const std::string_view name = word.substr(0, word.find('@'));
  if (!has(known, name)) {
    auto one = target::builtin_target(name);
    if (one == nullptr) return target::choose(word, with_builtin(known));
    known.push_back(std::move(one));
  }
  return target::choose(word, known);
}

}  // namespace

Result<std::vector<TargetChoice>> read_targets(const std::vector<std::string>& words,
                                               const std::vector<std::string>& files) {
  std::vector<TargetChoice> choices;
  if (words.empty()) return choices;
  auto known = own_targets(files);
  if (!known) return known.error();
  for (const std::string& list : words) {
    std::size_t begin = 0;
    while (begin <= list.size()) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      auto choice = choose(std::string_view(list).substr(begin, end - begin), *known);
      if (!choice) return Error{fmt::format("--target: {}.", choice.error().message)};
      choices.push_back(*std::move(choice));
      begin = end + 1;
    }
  }
  return choices;
}

std::vector<std::string> target_names(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  const auto own = own_targets(files);
  for (const auto& target : with_builtin(own ? *own : Targets())) {
    names.push_back(target->name);
  }
  return names;
}

}  // namespace gltfx::tool

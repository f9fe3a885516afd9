// SPDX-License-Identifier: Apache-2.0
#include "target/choice.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::target {
namespace {

using Numbers = std::vector<std::uint32_t>;

// The numbers of a version such as "0.187.0"; nothing when it is not a version.
std::optional<Numbers> numbers_of(std::string_view version) {
  Numbers numbers;
  const char* at = version.data();
  const char* const end = at + version.size();
  while (true) {
    std::uint32_t number = 0;
    const auto read = std::from_chars(at, end, number);
    if (read.ec != std::errc()) return std::nullopt;
    numbers.push_back(number);
    if (read.ptr == end) return numbers;
    if (*read.ptr != '.') return std::nullopt;
    at = read.ptr + 1;
  }
}

bool begins_with(const Numbers& version, const Numbers& start) {
  return start.size() <= version.size() && std::equal(start.begin(), start.end(), version.begin());
}

std::optional<std::size_t> find_version(const Target& target, const Numbers& wanted) {
  std::optional<std::size_t> before;
  std::optional<std::size_t> same;
  for (std::size_t i = 0; i < target.versions.size(); ++i) {
    const auto version = numbers_of(target.versions[i].version);
    if (!version) continue;
    if (begins_with(*version, wanted)) same = i;
    if (*version < wanted) before = i;
  }
  return same ? same : before;
}

Error unknown_target(std::string_view name,
                     std::span<const std::shared_ptr<const Target>> targets) {
  std::string names;
  for (const auto& target : targets) names += (names.empty() ? "" : ", ") + target->name;
  return Error{fmt::format("{} is no target; there are {}", gltfx::quoted(name), names)};
}

}  // namespace

Result<TargetChoice> choose(std::string_view word,
                            std::span<const std::shared_ptr<const Target>> targets) {
  const std::size_t at = word.find('@');
  const std::string_view name = word.substr(0, at);
  const auto found = std::find_if(targets.begin(), targets.end(),
                                  [&](const auto& target) { return target->name == name; });
  if (found == targets.end()) return unknown_target(name, targets);
  const Target& target = **found;
  if (at == std::string_view::npos || word.substr(at) == "@newest") {
    return TargetChoice{*found, target.versions.size() - 1};
  }
  const auto wanted = numbers_of(word.substr(at + 1));
  if (!wanted) {
    return Error{fmt::format("{} is no version, such as {}, nor 'newest'",
                             gltfx::quoted(word.substr(at + 1)), target.versions.back().version)};
  }
  const auto version = find_version(target, *wanted);
  if (!version) {
    return Error{fmt::format("the oldest measured version of {} is {}", name,
                             target.versions.front().version)};
  }
  return TargetChoice{*found, *version};
}

}  // namespace gltfx::target

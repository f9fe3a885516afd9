// SPDX-License-Identifier: Apache-2.0
#include "model/semantic.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace gltfx::model {
namespace {

constexpr std::array<std::string_view, kCoreSemanticCount> kPrefixes{
    "POSITION", "NORMAL", "TANGENT", "TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::uint64_t> parse_set(std::string_view digits) {
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), is_digit)) return std::nullopt;
  if (digits.size() > 1 && digits.front() == '0') return std::nullopt;
  std::uint64_t set = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), set);
  return result.ec == std::errc() ? set : UINT64_MAX;
}

}  // namespace

bool is_indexed(SemanticKind kind) {
  return kind == SemanticKind::texcoord || kind == SemanticKind::color ||
         kind == SemanticKind::joints || kind == SemanticKind::weights;
}

std::string_view semantic_prefix(SemanticKind kind) {
  const auto at = static_cast<std::size_t>(kind);
  return at < kPrefixes.size() ? kPrefixes[at] : std::string_view();
}

Semantic parse_semantic(std::string_view name) {
  if (name.starts_with('_')) return {SemanticKind::application, 0};
  for (std::size_t i = 0; i < kPrefixes.size(); ++i) {
    if (!name.starts_with(kPrefixes[i])) continue;
    const auto kind = static_cast<SemanticKind>(i);
    const std::string_view rest = name.substr(kPrefixes[i].size());
    if (!is_indexed(kind)) return {rest.empty() ? kind : SemanticKind::invalid, 0};
    const auto set = rest.starts_with('_') ? parse_set(rest.substr(1)) : std::nullopt;
    return set ? Semantic{kind, *set} : Semantic{};
  }
  return {semantic_extension(name).empty() ? SemanticKind::invalid : SemanticKind::extension, 0};
}

std::string_view semantic_extension(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos || colon + 1 == name.size()) return {};
  const std::string_view prefix = name.substr(0, colon);
  const std::size_t underscore = prefix.find('_');
  if (underscore == std::string_view::npos || underscore == 0) return {};
  return underscore + 1 < prefix.size() ? prefix : std::string_view();
}

bool matches_semantic(std::string_view pattern, std::string_view name) {
  if (!pattern.ends_with("_n")) return pattern == name;
  const std::string_view stem = pattern.substr(0, pattern.size() - 1);
  return name.starts_with(stem) && parse_set(name.substr(stem.size())).has_value();
}

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
#include "schema/version.hpp"

#include <algorithm>
#include <charconv>

#include "schema/set.hpp"

namespace gltfx::schema {
namespace {

std::optional<std::uint32_t> parse_part(std::string_view digits) {
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) {
    return std::nullopt;
  }
  std::uint32_t number = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return result.ec == std::errc() ? number : UINT32_MAX;
}

}  // namespace

std::optional<Version> parse_version(std::string_view text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const auto major = parse_part(text.substr(0, dot));
  const auto minor = parse_part(text.substr(dot + 1));
  if (!major || !minor) return std::nullopt;
  return Version{*major, *minor};
}

std::string version_text(const Version& version) {
  return std::to_string(version.major) + "." + std::to_string(version.minor);
}

Version stated_version(const json::Document& document) {
  const json::NodeId asset = document.find(document.root(), "asset");
  const json::NodeId place = document.find(asset, "version");
  if (place == json::kNoNode || !document.is_string(place)) return kVersion2;
  const auto version = parse_version(document.string(place));
  if (!version || version->major != kVersion2.major) return kVersion2;
  return *version;
}

Version judged_version(const json::Document& document, const Set& set) {
  return std::min(stated_version(document), set.newest_version());
}

}  // namespace gltfx::schema

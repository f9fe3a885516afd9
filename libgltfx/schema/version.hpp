// SPDX-License-Identifier: Apache-2.0
/// Versions of glTF: "2.1".
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "json/document.hpp"

namespace gltfx::schema {

struct Version {
  std::uint32_t major = 0;
  std::uint32_t minor = 0;
  friend auto operator<=>(const Version&, const Version&) = default;
};

/// The version of most assets.
inline constexpr Version kVersion2{2, 0};

/// Two decimal numbers with a dot between them; nothing for another text. Larger numbers than the
/// type can hold are its maximum.
std::optional<Version> parse_version(std::string_view text);
std::string version_text(const Version& version);

class Set;

/// `asset.version`, and 2.0 for an asset of another major version or without a version.
Version stated_version(const json::Document& document);
/// The version whose text an asset is judged by: the stated one, but at most the newest of the Set.
Version judged_version(const json::Document& document, const Set& set);

}  // namespace gltfx::schema

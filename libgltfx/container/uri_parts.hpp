// SPDX-License-Identifier: Apache-2.0
/// The components of a URI (RFC 3986 section 3).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gltfx::container {

/// Normalized as RFC 3986 sections 6.2.2 and 6.2.3 have it, but for the dot segments of a path that
/// is relative. What no URI may hold is escaped, and '\\' is read as '/'.
struct UriParts {
  std::string scheme;  ///< lower case; empty: none
  std::optional<std::string> authority;
  std::string path;
  std::optional<std::string> query, fragment;
  /// What is wrong with scheme, host or port, as the end of a sentence; the rest is unset then.
  std::string problem;

  bool has_place() const { return !scheme.empty() || authority || path.starts_with('/'); }
  std::string text() const;
};

UriParts split_uri(std::string_view uri);

}  // namespace gltfx::container

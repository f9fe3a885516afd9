// SPDX-License-Identifier: Apache-2.0
/// The components of a URI (RFC 3986 section 3).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gltfx::container {

/// Normalized as in RFC 3986 sections 6.2.2 and 6.2.3, except the dot segments of a relative path.
/// Forbidden characters are escaped, and '\\' is read as '/'.
struct UriParts {
  std::string scheme;  ///< lower case; empty: none
  std::optional<std::string> authority;
  std::string path;
  std::optional<std::string> query, fragment;
  /// The error in scheme, host or port, as the end of a sentence; the other members are then unset.
  std::string problem;

  bool has_place() const { return !scheme.empty() || authority || path.starts_with('/'); }
  std::string text() const;
};

UriParts split_uri(std::string_view uri);

}  // namespace gltfx::container

// SPDX-License-Identifier: Apache-2.0
/// Paths as URIs (RFC 3986, RFC 8089).
#pragma once

#include <string>
#include <string_view>

namespace gltfx::report {

/// A path as a URI in a report.
struct FileUri {
  std::string text;  ///< ASCII: everything but unreserved characters and '/' is percent-encoded
  bool relative = false;  ///< to the base folder
};

/// `path` below `folder` (absolute, or empty when it is not known) as a relative reference without
/// "." and ".." segments, any other as a file: URI; a path that leads out of an unknown folder
/// keeps its "..".
FileUri file_uri(std::string_view path, std::string_view folder);

/// An absolute folder as a file: URI that ends in '/'.
std::string folder_uri(std::string_view folder);

}  // namespace gltfx::report

// SPDX-License-Identifier: Apache-2.0
/// Paths in reports, as URIs (RFC 3986, RFC 8089) and plain.
#pragma once

#include <string>
#include <string_view>

namespace gltfx::report {

/// A path as a URI in a report.
struct FileUri {
  std::string text;  ///< ASCII: everything but unreserved characters and '/' is percent-encoded
  bool relative = false;  ///< to the base folder
};

/// `path` below `folder` (absolute, or empty when it is not known) without "." and ".." segments,
/// any other as an absolute path; a path that leads out of an unknown folder keeps its "..".
std::string path_below(std::string_view path, std::string_view folder);

/// The same as a relative reference or, for an absolute path, as a file: URI.
FileUri file_uri(std::string_view path, std::string_view folder);

/// An absolute folder as a file: URI that ends in '/'.
std::string folder_uri(std::string_view folder);

}  // namespace gltfx::report

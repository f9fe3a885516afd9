// SPDX-License-Identifier: Apache-2.0
/// Names of new files of an asset.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include "container/bytes.hpp"

namespace gltfx::steps {

/// A file name that is valid on any system, without its ending: the part after the last slash,
/// without characters and names that some systems refuse, cut to 56 code points. Empty: nothing is
/// left, or the name has unprintable characters.
std::string clean_name(std::string_view name);

/// The name with '_' in place of each byte that a URI would have as an escape (RFC 3986, section
/// 2.3): some engines do not decode these.
std::string unescaped_name(std::string name);

/// Whether a text is a media type without parameters ("image/png"), which a data URI can have.
bool is_media_type(std::string_view text);

/// The ending of an image file, with its dot: from its bytes, else from its media type; empty if
/// both are unknown.
std::string image_ending(const container::Bytes& bytes, std::string_view media_type);

/// Returns each name only once. Names that differ only in case count as equal.
class FileNames {
 public:
  /// `taken`: paths of existing files.
  explicit FileNames(const std::set<std::string>& taken);

  /// The name without `ending`, if it has that, then `mark`, a number if that is taken, and
  /// `ending`. Precondition: `name` is clean.
  std::string take(const std::string& name, std::string_view ending, std::string_view mark = {});

 private:
  std::set<std::string> taken_;  ///< in lower case
  /// The last number that was used for a name, in lower case.
  std::unordered_map<std::string, unsigned> numbers_;
};

}  // namespace gltfx::steps

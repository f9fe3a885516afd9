// SPDX-License-Identifier: Apache-2.0
/// Names of files that an asset gets beside it.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include "container/bytes.hpp"

namespace gltfx::steps {

/// What may be the name of a file on any system, without its ending: what stands behind the last
/// slash, without characters and names that some systems refuse, cut to 56 code points. Empty:
/// nothing is left, or the name has characters that are not shown as they are.
std::string clean_name(std::string_view name);

/// Whether a text is a media type without parameters, as a data URI can hold it: "image/png".
bool is_media_type(std::string_view text);

/// The ending of the file of an image, with its dot: by its bytes, else by its media type; empty
/// where neither tells.
std::string image_ending(const container::Bytes& bytes, std::string_view media_type);

/// Gives each name once, also where upper and lower case are the same.
class FileNames {
 public:
  /// `taken`: paths of files that are there.
  explicit FileNames(const std::set<std::string>& taken);

  /// The name, or one with a number behind it where that is taken. Precondition: `name` is clean.
  std::string take(const std::string& name, std::string_view ending);

 private:
  std::set<std::string> taken_;  ///< in lower case
  /// The last number of a name that was taken, likewise.
  std::unordered_map<std::string, unsigned> numbers_;
};

}  // namespace gltfx::steps

// SPDX-License-Identifier: Apache-2.0
/// The pictures of a comparison as files of one folder.
#pragma once

#include <gltfx/compare.hpp>

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace gltfx::tool {

/// Gives each pair of a run names of its own.
class ComparePictureFiles {
 public:
  /// `folder`: empty: nothing is written.
  explicit ComparePictureFiles(std::string folder) : folder_(std::move(folder)) {}

  /// Makes the folder, and checks that files can be created in it.
  std::optional<Error> prepare() const;
  /// Writes PNG files, each whole, and sets their names in the report. `place`: the path of the
  /// pair, from which the names are made.
  std::optional<Error> write(CompareReport& report, std::string_view place);

 private:
  std::string name_for(std::string_view place);

  std::string folder_;
  std::set<std::string> taken_;  ///< in small letters
};

/// A prefix of links to these files that no part of Markdown ends: without blanks, brackets and
/// characters that are not of ASCII.
std::string link_prefix(std::string_view prefix);

}  // namespace gltfx::tool

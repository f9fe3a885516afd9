// SPDX-License-Identifier: Apache-2.0
/// The pages of own rules that a run names, on the command line and in its configuration.
#pragma once

#include <gltfx/own_rules.hpp>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace gltfx::tool {

/// Each page is read and compiled once. Paths that select pages later must have been read.
class OwnPages {
 public:
  /// Reads and compiles the pages of files and folders, together with those read before. The Error
  /// has a line for each mistake: "house/ACME_NAME.md:12: mistake".
  std::optional<Error> read(const std::vector<std::string>& paths);

  /// The rules of these paths; null: none.
  std::shared_ptr<const OwnRules> of(const std::vector<std::string>& paths) const;
  /// All rules; null: none.
  const std::shared_ptr<const OwnRules>& all() const { return all_; }

 private:
  std::map<std::string, std::vector<std::string>> files_;  ///< by path that names them
  std::set<std::string> known_;                            ///< files that were read
  std::shared_ptr<const OwnRules> all_;
};

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
/// The pairs of assets of a comparison.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "git_tree.hpp"
#include "pipeline/compare_opened.hpp"

namespace gltfx::tool {

/// Two assets to compare.
struct ComparePair {
  std::string before, after;  ///< names for reports; an empty one: the asset is missing there
  /// Null: the name is the path of a file.
  OpenCompared open_before = nullptr, open_after = nullptr;
  std::vector<std::string> external_asset_of = {};  ///< as CompareReport has it
};

/// The assets that git says have changed, and those that refer to changed files. Renames are pairs.
struct GitPairs {
  std::vector<ComparePair> pairs;  ///< their functions refer to the trees
  std::vector<std::unique_ptr<GitTree>> trees;
};

/// `range`: as read_git_range() has it. `paths`: files and folders that the assets must be in;
/// empty: all. The Error is for a user.
Result<GitPairs> find_git_pairs(const std::string& range, const std::vector<std::string>& paths);

}  // namespace gltfx::tool

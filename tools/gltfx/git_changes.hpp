// SPDX-License-Identifier: Apache-2.0
/// What changed between two commits, or since a commit, as git tells it.
#pragma once

#include <string>
#include <vector>

#include "git_index.hpp"

namespace gltfx::tool {

/// Two sides of a comparison, as the user names them and as hexadecimal digits.
struct GitRange {
  struct Commit {
    std::string name;
    std::string id;  ///< empty: the working tree
  };
  Commit before, after;
};

/// "BASE", "A..B" or "A...B" (since the common ancestor), as `git diff` reads them. The Error is
/// for a user; git has said more on standard error.
Result<GitRange> read_git_range(const std::string& text);

/// A file that was changed, added, deleted or renamed.
struct GitChange {
  RepositoryName before, after;  ///< empty: there is none
  /// Whether they are files or links, and not submodules.
  bool file_before = false, file_after = false;
};

/// In the order of their names. Files that git does not track are not among them.
Result<std::vector<GitChange>> read_git_changes(const std::string& top, const GitRange& range);

/// Parses the output of `git diff --raw -z`.
std::vector<GitChange> parse_git_changes(std::string_view text);

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
/// The files of a commit of the repository around the working directory: of the next one (its
/// index) or of an earlier one.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "git.hpp"

namespace gltfx::tool {

/// Paths below the top folder of the working tree, with '/', of arbitrary bytes.
using RepositoryName = std::string;

/// IndexEntry::mode of a symbolic link.
inline constexpr std::string_view kSymbolicLink = "120000";

struct IndexEntry {
  std::string mode;    ///< "100644", of a submodule "160000"
  std::string object;  ///< in hexadecimal digits
};

/// Read once, then constant. The calls run git; an Error says that it failed.
class GitIndex {
 public:
  static Result<GitIndex> open();
  /// The files of a commit, which may be one of a repository without a working tree.
  static Result<GitIndex> at(const std::string& commit);

  /// The top folder of the working tree.
  const std::string& folder() const { return git_.folder(); }

  const std::map<RepositoryName, IndexEntry>& entries() const { return entries_; }
  /// A regular file of that name.
  const IndexEntry* file(const RepositoryName& name) const;
  /// Whether the path leads into a submodule or through a symbolic link, where the index of this
  /// repository has no entries.
  bool leads_elsewhere(const RepositoryName& name) const;

  /// The name of a path of the working directory; nothing for one outside the working tree.
  std::optional<RepositoryName> name_of(const std::string& path) const;
  /// The path of a name, from the working directory.
  std::string path_of(const RepositoryName& name) const;

  /// Differences between the last commit and the index: names with git's letter, 'A' for a new
  /// file, 'D' for a deleted one. A rename is both.
  Result<std::map<RepositoryName, char>> staged() const;
  /// Differences between the index and the working tree.
  Result<std::set<RepositoryName>> unstaged() const;
  /// Those of the names that .gitignore excludes.
  std::set<RepositoryName> ignored(const std::set<RepositoryName>& names) const;
  /// Those of the names that .gitattributes sends to Git LFS.
  Result<std::set<RepositoryName>> kept_by_lfs(const std::set<RepositoryName>& names) const;
  /// Calls `visit` with the start of each file: the whole of a text, the JSON of a GLB.
  std::optional<Error> read(
      const std::vector<RepositoryName>& names,
      const std::function<void(const RepositoryName&, std::string&&)>& visit) const;

 private:
  explicit GitIndex(std::string top) : git_(std::move(top)) {}
  Result<std::string> ask(const std::vector<std::string>& arguments,
                          std::string_view input = {}) const;
  std::optional<Error> read_entries(const std::vector<std::string>& listing);

  Git git_;
  std::map<RepositoryName, IndexEntry> entries_;
};

}  // namespace gltfx::tool

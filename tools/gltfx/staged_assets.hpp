// SPDX-License-Identifier: Apache-2.0
/// The assets of a commit, and whether the commit has all files that they refer to.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "git_index.hpp"

namespace gltfx::tool {

using References = std::map<RepositoryName, std::set<RepositoryName>>;

/// Assets of a repository with the files that they refer to.
class StagedAssets {
 public:
  explicit StagedAssets(const GitIndex& index) : index_(index) {}

  /// Finds the assets among `names`, and in the index those that refer to other names, or to an
  /// asset that is found. All names may be deleted files.
  std::optional<Error> find(const std::set<RepositoryName>& names);
  /// Reads the references of the found assets again, from the working tree, except those whose
  /// index and file differ on purpose.
  void look_at_files(const std::set<RepositoryName>& but);

  const std::set<RepositoryName>& found() const { return found_; }
  /// The references found; names that lead out of the repository are left out.
  const References& references() const { return references_; }

 private:
  void note(const RepositoryName& asset, std::string&& bytes);
  void note_file(const RepositoryName& asset);
  void add_parents_of(const std::set<RepositoryName>& assets);

  const GitIndex& index_;
  std::set<RepositoryName> found_;
  References references_;
};

/// The problems of a commit.
struct CommitCheck {
  std::set<RepositoryName> to_stage;                 ///< existing files that only have to be staged
  std::map<RepositoryName, RepositoryName> missing;  ///< with an asset that refers to them
  std::map<RepositoryName, RepositoryName> ignored;  ///< the same, left out by .gitignore
  std::map<RepositoryName, RepositoryName> not_lfs;  ///< with one beside it that Git LFS keeps
};

/// `staged`: from GitIndex.
Result<CommitCheck> check_commit(const GitIndex& index, const StagedAssets& assets,
                                 const std::map<RepositoryName, char>& staged);

/// `text` quoted as a word of a shell command, without characters that could control a terminal.
std::string shell_word(std::string_view text);

}  // namespace gltfx::tool

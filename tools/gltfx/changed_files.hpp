// SPDX-License-Identifier: Apache-2.0
/// Differences between a revision of git and the files in the working tree. Only the repository of
/// the working folder is used: one beside an asset could start programs of its own.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "git_index.hpp"

namespace gltfx::tool {

class ChangedFiles {
 public:
  /// An Error when there is no repository or no such revision.
  static Result<ChangedFiles> since(const std::string& revision);

  /// Changed lines of a file. Nothing if the whole file counts: it is new, binary, kept by Git LFS,
  /// or not of this repository.
  std::optional<std::vector<LineRange>> lines(const std::string& path) const;
  /// Whether a file that the asset refers to changed, so that all findings count.
  bool companions_changed(const FileReport& report) const;

 private:
  enum class State : std::uint8_t { same, changed, unknown };
  ChangedFiles(GitIndex index, std::string commit)
      : index_(std::move(index)), commit_(std::move(commit)) {}
  std::optional<Error> read();
  State state_of(const std::string& path) const;

  GitIndex index_;
  std::string commit_;
  std::set<RepositoryName> known_;    ///< at the revision
  std::set<RepositoryName> changed_;  ///< of these
};

/// The lines of the new file that a unified diff without context names; a removed line marks its
/// neighbours. Nothing when it is a diff of Git LFS pointers, whose lines are not those of the
/// file.
std::optional<std::vector<LineRange>> lines_of_diff(std::string_view diff);

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
/// The contents of the files of a commit, read without checking them out.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "container/bytes.hpp"
#include "git_index.hpp"
#include "model/opened_asset.hpp"

namespace gltfx::tool {

/// Reads files of the commit. Symbolic links are followed inside the commit. A file that Git LFS
/// keeps is what the user's filter makes of its pointer. Neither copied nor moved: assets that it
/// opens refer to it. Thread-safe.
class GitTree {
 public:
  /// `label`: what messages call the commit.
  GitTree(GitIndex index, std::string label) : index_(std::move(index)), label_(std::move(label)) {}
  GitTree(const GitTree&) = delete;
  GitTree& operator=(const GitTree&) = delete;

  const GitIndex& index() const { return index_; }
  const std::string& label() const { return label_; }
  /// Where a name leads after all links, whether there is a file or not; nothing: out of the
  /// commit.
  std::optional<RepositoryName> follow(const RepositoryName& name);
  /// The bytes of a file; nothing: there is none, or it is among the problems.
  std::optional<container::Bytes> read(const RepositoryName& name);
  /// Gives the files that an asset refers to, inside the repository.
  container::Resolver resolver(const RepositoryName& asset);
  /// An asset and what it refers to; `shown` is its name in reports.
  Result<model::OpenedAsset> open(const RepositoryName& asset, std::string shown);
  /// Sentences about files that could not be read since the last call.
  std::vector<std::string> take_problems();

 private:
  struct Loaded {
    std::optional<std::string> bytes;
    std::string problem;  ///< empty: there is no such file, or all is well
  };
  Loaded load(const RepositoryName& name);
  std::optional<std::string> blob(const std::string& object);
  std::optional<std::string> filtered(const RepositoryName& name, const std::string& object) const;

  const GitIndex index_;
  const std::string label_;
  std::mutex reading_, noting_;
  std::optional<GitProcess> batch_;  ///< started at the first question
  std::vector<std::string> problems_;
};

}  // namespace gltfx::tool

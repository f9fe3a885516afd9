// SPDX-License-Identifier: Apache-2.0
/// One asset of a group that is fixed together.
#pragma once

#include <gltfx/fix.hpp>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "change/commit.hpp"
#include "change/shared_bytes.hpp"
#include "pipeline/edit_asset.hpp"
#include "pipeline/fix_rounds.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// A file as an asset uses it.
struct FileUse {
  std::set<std::string> paths;  ///< as container::Uri has them
  change::FileReads reads;      ///< before and after the fixes
};

/// What is made of a file by all assets that share it.
struct NewContent {
  FileState state;
  container::Bytes before, after;
};
using NewContents = std::map<FileIdentity, NewContent>;

/// An asset, what fixes make of it, and what is said of that.
class FixMember {
 public:
  /// Of the asset at `path`, or why it could not be opened; `options` with its own output. Does not
  /// throw but for memory.
  FixMember(const std::string& path, Result<EditedAsset> opened, FixOptions options,
            std::shared_ptr<const schema::Set> schemas);

  /// Makes the fixes, anew where some were made before.
  void plan(const FileGuard& guard);
  /// Finds out what is read of which files; plan() is to be called before.
  void find_uses();

  /// Whether there is something to write or to look at: no problem so far.
  bool is_sound() const { return report_.problem == EditProblem::none; }
  /// Whether the old file is to be replaced.
  bool replaces_asset() const;
  const std::map<FileIdentity, FileUse>& uses() const { return uses_; }
  /// The files that the fixes change, by a path of each.
  std::map<FileIdentity, const change::ReplacedFile*> changed_files() const;
  const std::string& path() const { return report_.path; }
  /// Whether no file of it is on a disk.
  bool is_in_memory() const;
  /// Whether files change where they lie, or would if the run wrote something.
  bool changes_files_in_place() const;

  /// What is to be written; nothing where there is nothing to do. Refers to this.
  std::optional<change::AssetWrite> write(const NewContents& contents);
  /// What write() would write where the options ask for it. Nothing is made after that.
  std::optional<Draft> take_draft(const NewContents& contents);
  /// What became of that.
  void note(const std::optional<change::WriteFailure>& failure);
  void fail(EditProblem problem, std::string why);

  /// Whether the old asset would have a new finding with the new contents.
  bool is_worse_with(const NewContents& contents) const;

  FixReport take_report();

 private:
  bool is_in_place() const;
  ValidateOptions validation() const;
  model::OpenedAsset opened() const;
  model::OpenedAsset take_opened();
  void use(const model::OpenedAsset& asset);
  std::vector<change::ReplacedFile> replaced_by(const NewContents& contents) const;

  FixOptions options_;
  std::shared_ptr<const schema::Set> schemas_;
  std::optional<EditedAsset> old_;
  std::optional<FixedAsset> fixed_;
  std::set<std::string> referred_;  ///< paths that the new asset refers to
  std::map<FileIdentity, FileUse> uses_;
  FixReport report_;
};

}  // namespace gltfx

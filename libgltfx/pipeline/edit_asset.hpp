// SPDX-License-Identifier: Apache-2.0
/// What verbs that change an asset have in common: a change becomes a draft, which is proven and
/// then written.
#pragma once

#include <gltfx/edited_file.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "change/apply.hpp"
#include "change/commit.hpp"
#include "json/edit.hpp"
#include "model/opened_asset.hpp"
#include "pipeline/named_files.hpp"
#include "pipeline/open_asset.hpp"
#include "rules/validated_asset.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// The asset at `path`, with the state of its file from before it was read, or why there is none.
struct EditedAsset {
  model::OpenedAsset asset;
  FileState state;
};
Result<EditedAsset> open_to_edit(const std::string& path, const AssetBounds& bounds);

/// Some writers fill the JSON chunk up with zeros; the new one gets blanks.
container::Container without_zero_padding(container::Container container);

/// Why objects of an asset cannot be moved or taken out, as half a sentence; nothing when they can:
/// what its text means is clear, and its container can be written anew.
std::optional<std::string> find_edit_obstacle(const model::OpenedAsset& asset);

/// The asset that a change makes, proven, and the files that come with it.
struct Draft {
  validate::ValidatedAsset asset;
  std::vector<change::NewFile> files = {};
  std::vector<change::ReplacedFile> replaced = {};
};

/// Says that nothing was done, and why.
void note_failure(EditOutcome& outcome, EditProblem problem, std::string error);

/// Whether something is to be written at all.
bool writes(const EditOptions& options);

/// Says in `outcome` what became of an asset that was to be written. Whether all is written.
bool note_written(const std::optional<change::WriteFailure>& failure, const EditOptions& options,
                  EditOutcome& outcome);

/// One asset that is to be changed. Refers to all it is made of.
struct EditedFile {
  const model::OpenedAsset& before;
  const FileState& state;  ///< of the file, from before it was read
  const EditOptions& options;
  const std::shared_ptr<const schema::Set>& schemas;
  FolderIndex& folders;
  unsigned jobs = 1;  ///< threads that validate the draft
};

/// Why a draft, which was validated with default options, must not take the place of the old asset,
/// or nothing.
using Proof = std::function<std::optional<std::string>(const validate::ValidatedAsset& draft)>;

/// Makes the draft of a change that is placed, has it proven, and writes it where the options say,
/// if they do. The draft; nothing where it failed, as `outcome` says then. Refused where an asset
/// of `folders` reads the file that would be replaced.
std::optional<Draft> carry_out(const EditedFile& file, change::Change change, const Proof& proof,
                               EditOutcome& outcome, change::NewText now = {});

/// Why the asset at `path` must not be replaced by other bytes, or nothing: another one that lies
/// beside it reads its bytes.
std::optional<std::string> find_reader(const std::string& path, FolderIndex& folders);

/// Writes the asset as it is, where it is wanted somewhere else; in place, what a killed run has
/// left beside it goes.
bool copy_unchanged(const model::OpenedAsset& old, const FileState& state,
                    const EditOptions& options, EditOutcome& outcome);

/// For EditOutcome::diff. `edits` are those of the asset's text. `applies`: the container stays, so
/// that the diff of a .gltf may be a patch.
std::string diff_of(const model::OpenedAsset& asset, const std::vector<json::Edit>& edits,
                    bool applies = true);

}  // namespace gltfx

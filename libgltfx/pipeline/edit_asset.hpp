// SPDX-License-Identifier: Apache-2.0
/// What verbs that change an asset have in common, around edit::write_asset().
#pragma once

#include <gltfx/edited_file.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/file_state.hpp"
#include "edit/write_asset.hpp"
#include "json/edit.hpp"
#include "model/opened_asset.hpp"
#include "pipeline/named_files.hpp"
#include "pipeline/open_asset.hpp"

namespace gltfx {

/// The asset at `path`, with the state of its file from before it was read, or why there is none.
struct EditedAsset {
  model::OpenedAsset asset;
  FileState state;
};
Result<EditedAsset> open_to_edit(const std::string& path, const AssetBounds& bounds);

/// Some writers fill the JSON chunk up with zeros; the new one gets blanks.
container::Container without_zero_padding(container::Container container);

/// Says that nothing was done, and why.
void note_failure(EditOutcome& outcome, EditProblem problem, std::string error);

/// What edit::write_assets() is to write where the options say. `state` is that of the old file;
/// `old` has to live as long.
edit::AssetWrite asset_write(const model::OpenedAsset& old, const FileState& state,
                             edit::NewBytes bytes, const EditOptions& options,
                             edit::WriteCheck check);

/// Says in `outcome` what became of that. Whether all is written.
bool note_written(const std::optional<edit::WriteFailure>& failure, const EditOptions& options,
                  EditOutcome& outcome);

/// Both, of one asset. Refused where an asset of `folders` reads the file that would be replaced.
bool write_edited(const model::OpenedAsset& old, const FileState& state, edit::NewBytes bytes,
                  const EditOptions& options, edit::WriteCheck check, FolderIndex& folders,
                  EditOutcome& outcome);

/// Why the asset at `path` must not be replaced by other bytes, or nothing: another one that lies
/// beside it reads its bytes.
std::optional<std::string> find_reader(const std::string& path, FolderIndex& folders);

/// Writes the asset as it is, where it is wanted somewhere else; in place, what a killed run has
/// left beside it goes.
bool copy_unchanged(const model::OpenedAsset& old, const FileState& state,
                    const EditOptions& options, EditOutcome& outcome);

/// For EditOutcome::diff. `edits` are those of the asset's text.
std::string diff_of(const model::OpenedAsset& asset, const std::vector<json::Edit>& edits);

}  // namespace gltfx

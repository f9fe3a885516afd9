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

namespace gltfx {

/// The asset at `path`, with the state of its file from before it was read, or why there is none.
struct EditedAsset {
  model::OpenedAsset asset;
  FileState state;
};
Result<EditedAsset> open_to_edit(const std::string& path, const std::string& root);

/// Some writers fill the JSON chunk up with zeros; the new one gets blanks.
container::Container without_zero_padding(container::Container container);

/// Says that nothing was done, and why.
void note_failure(EditOutcome& outcome, EditProblem problem, std::string error);

/// Writes where the options say, and says in `outcome` what became of it. `state` is that of the
/// old file, `check` as edit::write_asset() takes it. Whether all is written.
bool write_edited(const model::OpenedAsset& old, const FileState& state,
                  const edit::NewBytes& bytes, const EditOptions& options,
                  const edit::WriteCheck& check, EditOutcome& outcome);

/// Writes the asset as it is, where it is wanted somewhere else.
bool copy_unchanged(const model::OpenedAsset& old, const FileState& state,
                    const EditOptions& options, EditOutcome& outcome);

/// For EditOutcome::diff. `edits` are those of the asset's text.
std::string diff_of(const model::OpenedAsset& asset, const std::vector<json::Edit>& edits);

}  // namespace gltfx

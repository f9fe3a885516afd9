// SPDX-License-Identifier: Apache-2.0
/// Verbs that change an asset in memory: a draft that was proven is given back.
#pragma once

#include <gltfx/edited_bytes.hpp>
#include <gltfx/memory_asset.hpp>

#include <map>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "base/result.hpp"
#include "container/bytes.hpp"
#include "pipeline/edit_asset.hpp"

namespace gltfx {

/// To be edited in memory. The bytes are shared.
EditedAsset to_edit(const model::OpenedAsset& asset);

/// Opens an asset to edit it. An Error where the options ask for files.
Result<EditedAsset> open_to_edit(MemoryAsset asset, const EditOptions& options);

/// The bytes that commit() would write. An Error when they cannot be a file.
Result<std::string> bytes_of(const Draft& draft);

/// Those beside the asset that commit() would write, by their paths from its folder.
std::map<std::string, std::string> files_of(const Draft& draft);

/// What `edit` makes of an asset: it gets the opened asset and the report, and gives the draft
/// back; nothing where the asset stays or the report has a problem. Does not throw.
template <class Report, class Edit>
EditedBytes<Report> edit_bytes(MemoryAsset asset, const EditOptions& options, const Edit& edit) {
  EditedBytes<Report> edited;
  const std::string name = asset.name;
  const auto fail = [&](EditProblem problem, std::string why) {
    edited = {};
    edited.report.path = name;
    note_failure(edited.report, problem, std::move(why));
    return std::move(edited);
  };
  try {
    edited.report.path = name;
    auto opened = open_to_edit(std::move(asset), options);
    if (!opened) return fail(EditProblem::refused, opened.error().message);
    const container::Bytes before = opened->asset.container().bytes;
    const std::optional<Draft> draft = edit(*std::move(opened), edited.report);
    if (edited.report.problem != EditProblem::none) return edited;
    Result<std::string> bytes = draft ? bytes_of(*draft) : std::string(before.text());
    if (!bytes) return fail(EditProblem::refused, bytes.error().message);
    edited.bytes = *std::move(bytes);
    if (draft) edited.files = files_of(*draft);
  } catch (const std::bad_alloc&) {
    return fail(EditProblem::unreadable, "there is not enough memory to edit this file");
  }
  return edited;
}

}  // namespace gltfx

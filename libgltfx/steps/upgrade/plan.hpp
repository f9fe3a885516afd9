// SPDX-License-Identifier: Apache-2.0
/// The changes of a document that replace its legacy extensions by their successors. All data about
/// these extensions comes from the schema files.
#pragma once

#include <gltfx/upgrade.hpp>

#include <cstdint>
#include <vector>

#include "change/change.hpp"
#include "json/document.hpp"
#include "model/asset_bytes.hpp"
#include "schema/set.hpp"
#include "steps/upgrade/image_job.hpp"
#include "steps/upgrade/pictures.hpp"

namespace gltfx::upgrade {

/// Pure data; nothing is changed yet.
struct Plan {
  std::vector<UpgradeAction> actions;  ///< by extension, then in the order of the document
  /// Textures that a slot used before and does not use now, also if they are used by an index that
  /// is not in a schema.
  std::vector<std::uint64_t> released;
  change::Change change;  ///< changes of the actions that are done; change::place() comes next
  std::vector<ImageJob> images;  ///< sources of its new images, by position
};

/// Whether a plan for the document can have actions: it names an extension with an upgrade, or has
/// version 1.0.
bool names_legacy(const json::Document& document, const schema::Set& set);

/// Makes a plan for a document that was read to its end; if it has errors, find_ambiguity() checks
/// whether the plan is reliable. Linear in its size, times the number of extensions. Uses the
/// options `generation`, `only`, `to`, `ior`, `unsafe` and `pack`. `pictures` are the document's
/// images; without them, objects that need pixels are not upgraded. `bytes` are the data of its
/// buffers; without them, vertex colours and keyframes cannot be read.
Plan make_plan(const json::Document& document, const schema::Set& set,
               const UpgradeOptions& options, Pictures* pictures = nullptr,
               model::AssetBytes* bytes = nullptr);

}  // namespace gltfx::upgrade

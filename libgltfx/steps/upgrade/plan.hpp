// SPDX-License-Identifier: Apache-2.0
/// What has to change in a document to bring its legacy extensions to their successors. Everything
/// that is known of these comes from the schema files.
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

/// Pure data; nothing was changed yet.
struct Plan {
  std::vector<UpgradeAction> actions;  ///< by extension, then in the order of the document
  /// Textures that some slot showed and shows no more, also by an index that no schema knows as
  /// one.
  std::vector<std::uint64_t> released;
  change::Change change;         ///< of the actions that are done; change::place() is to follow
  std::vector<ImageJob> images;  ///< what is to be made for its new images, by position
};

/// Whether a plan for the document would hold anything, or look for it: it names an extension that
/// has an upgrade, or is of glTF 1.0.
bool names_legacy(const json::Document& document, const schema::Set& set);

/// Plans for a document that was read to its end; where it has errors, find_ambiguity() says
/// whether the plan can be trusted. Time is linear in its size but for the number of extensions.
/// `generation`, `only`, `to`, `ior`, `unsafe` and `pack` of the options are looked at. `pictures`
/// are the document's images; without them what needs pixels is left alone. `bytes` are those of
/// its buffers; without them vertex colours and keyframes cannot be looked at.
Plan make_plan(const json::Document& document, const schema::Set& set,
               const UpgradeOptions& options, Pictures* pictures = nullptr,
               model::AssetBytes* bytes = nullptr);

}  // namespace gltfx::upgrade

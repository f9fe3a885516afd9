// SPDX-License-Identifier: Apache-2.0
/// What has to change in a document to bring its legacy extensions to their successors. Everything
/// that is known of these comes from the schema files.
#pragma once

#include <gltfx/upgrade.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "json/document.hpp"
#include "json/edit.hpp"
#include "schema/set.hpp"

namespace gltfx::upgrade {

/// A texture whose image has the right values in another channel than the successor reads.
struct TextureJob {
  std::string pointer;        ///< of the slot in the old document
  std::uint64_t texture = 0;  ///< index into the root's textures
  std::string swizzle;        ///< "r>a"
};

/// Pure data; nothing was changed yet.
struct Plan {
  std::vector<UpgradeAction> actions;  ///< by extension, then in the order of the document
  std::vector<TextureJob> textures;    ///< what the actions that need an image wait for
  std::vector<json::Edit> edits;       ///< of the actions that are done; for json::apply_edits()
};

/// Plans for a document that was read to its end; where it has faults, find_ambiguity() says
/// whether the plan can be trusted. Time is linear in its size but for the number of extensions.
/// Only `generation` and `unsafe` of the options are looked at.
Plan make_plan(const json::Document& document, const schema::Set& set,
               const UpgradeOptions& options);

}  // namespace gltfx::upgrade

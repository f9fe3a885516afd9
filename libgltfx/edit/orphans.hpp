// SPDX-License-Identifier: Apache-2.0
/// Textures that nothing refers to any more because of an upgrade, with the images and buffer views
/// that only they led to.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "edit/references.hpp"
#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::edit {

/// Indices by root array: "textures", "images", "bufferViews". Each was referred to before.
using Orphans = std::map<std::string, std::set<std::uint64_t>>;

/// Those that may become orphans: what a document refers to, and textures that were `released`,
/// whatever its references say.
Orphans referred_elements(const json::Document& document, const References& references,
                          const std::vector<std::uint64_t>& released);

/// Which of them are orphans in `now`: their document with changes, and additions behind the ends
/// of root arrays.
Orphans find_orphans(Orphans referred, const json::Document& now, const References& now_references);

}  // namespace gltfx::edit

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

/// Those of `now`, which is `before` with changes and additions behind the ends of root arrays.
/// `released` are textures that were referred to before, whatever the references say.
Orphans find_orphans(const json::Document& before, const References& before_references,
                     const std::vector<std::uint64_t>& released, const json::Document& now,
                     const References& now_references);

}  // namespace gltfx::edit

// SPDX-License-Identifier: Apache-2.0
/// glTF 1.0, in which nothing of an upgrade has a meaning.
#pragma once

#include <gltfx/upgrade.hpp>

#include <optional>
#include <string>

#include "json/document.hpp"

namespace gltfx::upgrade {

/// What is to be said of an asset of glTF 1.0. It counts as left to do, unless the options limit
/// the run to extensions. `pointer` is the place that states the version; empty: none does.
UpgradeAction old_format(const UpgradeOptions& options, std::string pointer = {},
                         const std::string& version = "1.0");

/// The same of a document, or nothing when it is of another version.
std::optional<UpgradeAction> find_old_format(const json::Document& document,
                                             const UpgradeOptions& options);

}  // namespace gltfx::upgrade

// SPDX-License-Identifier: Apache-2.0
/// Documents with errors: the errors that do not make an edit ambiguous. Assets of glTF 1.0, which
/// cannot be upgraded.
#pragma once

#include <gltfx/upgrade.hpp>

#include <optional>
#include <string>

#include "json/document.hpp"
#include "json/parse.hpp"
#include "steps/upgrade/plan.hpp"

namespace gltfx::upgrade {

/// The action for an asset of glTF 1.0. It counts as remaining work, unless the options limit the
/// run to extensions. `pointer` is the place of the version; empty: no version.
UpgradeAction old_format(const UpgradeOptions& options, std::string pointer = {},
                         const std::string& version = "1.0");

/// The same for a document, or nothing if it has another version.
std::optional<UpgradeAction> find_old_format(const json::Document& document,
                                             const UpgradeOptions& options);

/// An error of the text that makes the plan ambiguous, with its place; nothing if the planned edits
/// have the same meaning however a reader treats the errors: byte order marks, trailing commas and
/// numbers out of range anywhere; a missing comma or a repeated name outside of the places that the
/// plan depends on. Precondition: the plan is for that document, which was read to its end.
std::optional<std::string> find_ambiguity(const json::Parsed& parsed, const Plan& plan);

}  // namespace gltfx::upgrade

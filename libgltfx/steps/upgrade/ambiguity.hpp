// SPDX-License-Identifier: Apache-2.0
/// Documents with errors: which of these leave no doubt about an edit. glTF 1.0, in which nothing
/// of an upgrade has a meaning.
#pragma once

#include <gltfx/upgrade.hpp>

#include <optional>
#include <string>

#include "json/document.hpp"
#include "json/parse.hpp"
#include "steps/upgrade/plan.hpp"

namespace gltfx::upgrade {

/// What is to be said of an asset of glTF 1.0. It counts as left to do, unless the options limit
/// the run to extensions. `pointer` is the place that states the version; empty: none does.
UpgradeAction old_format(const UpgradeOptions& options, std::string pointer = {},
                         const std::string& version = "1.0");

/// The same of a document, or nothing when it is of another version.
std::optional<UpgradeAction> find_old_format(const json::Document& document,
                                             const UpgradeOptions& options);

/// Where and how an error of the text stands against the plan, or nothing when the planned edits
/// say the same whatever a reader makes of the errors: byte order marks, trailing commas and
/// numbers out of range anywhere; a missing comma or a repeated name that lies apart from all that
/// the plan was made from. Precondition: the plan is of that document, which was read to its end.
std::optional<std::string> find_ambiguity(const json::Parsed& parsed, const Plan& plan);

}  // namespace gltfx::upgrade

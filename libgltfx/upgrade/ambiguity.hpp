// SPDX-License-Identifier: Apache-2.0
/// Documents with errors: which of these leave no doubt about an edit.
#pragma once

#include <optional>
#include <string>

#include "json/parse.hpp"
#include "upgrade/plan.hpp"

namespace gltfx::upgrade {

/// Where and how an error of the text stands against the plan, or nothing when the planned edits
/// say the same whatever a reader makes of the errors: byte order marks, trailing commas and
/// numbers out of range anywhere; a missing comma or a repeated name that lies apart from all that
/// the plan was made from. Precondition: the plan is of that document, which was read to its end.
std::optional<std::string> find_ambiguity(const json::Parsed& parsed, const Plan& plan);

}  // namespace gltfx::upgrade

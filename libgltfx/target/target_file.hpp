// SPDX-License-Identifier: Apache-2.0
/// Reads files of targets and features. The text is untrusted: users may have targets of their own.
/// Their formats are schema/meta/target.schema.json and schema/meta/features.schema.json.
#pragma once

#include <gltfx/targets.hpp>

#include <map>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "target/repair.hpp"

namespace gltfx::target {

/// The Error is a clause that names the line, if any.
Result<Target> read_target(std::string_view text);

/// The same for the list of features.
Result<std::map<std::string, Feature, std::less<>>> read_features(std::string_view text);

/// The repairs in that list, by feature.
Result<std::map<std::string, Repair, std::less<>>> read_repairs(std::string_view text);

}  // namespace gltfx::target

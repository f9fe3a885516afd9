// SPDX-License-Identifier: Apache-2.0
/// Examples of own rules.
#pragma once

#include <gltfx/own_rules.hpp>
#include <gltfx/report.hpp>

#include <memory>
#include <string_view>

namespace gltfx {

/// The findings on an example of the rule of `own` with that code, and no others.
FileReport validate_own_example(std::string_view code, std::string_view example,
                                const std::shared_ptr<const OwnRules>& own);

}  // namespace gltfx

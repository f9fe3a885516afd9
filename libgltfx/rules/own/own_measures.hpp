// SPDX-License-Identifier: Apache-2.0
/// The measures that own rules name.
#pragma once

#include <gltfx/measure.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rules/context.hpp"
#include "rules/own/own_page.hpp"

namespace gltfx::measure {
class Source;
}

namespace gltfx::validate {

/// The scope of measures for objects of a rule; nothing: they have none.
std::optional<MeasureScope> measure_scope_of(const OwnScope& scope);

/// The measures whose names are members in the schema of a page, sorted.
std::vector<const MeasureDescription*> named_measures(const OwnPage& page);

/// Takes the measures whose names are members in a schema of a rule that is enabled. Nothing
/// without such a name.
std::optional<Measurements> take_own_measures(const Context& context,
                                              const measure::Source& source);

}  // namespace gltfx::validate

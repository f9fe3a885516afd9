// SPDX-License-Identifier: Apache-2.0
/// What values attributes may have that extensions bring.
#pragma once

#include <optional>
#include <string_view>

#include "model/accessor.hpp"
#include "validate/data/check.hpp"

namespace gltfx::validate {

/// The check of a vertex attribute by its whole name; nothing where any finite value may stand.
std::optional<CheckKind> vertex_value_check(std::string_view name);

/// The check of an attribute of instances.
std::optional<CheckKind> instance_value_check(std::string_view name, const model::Format& format);

/// How far from 1 a unit vector of `components` numbers of that type may be when each of them is
/// off by one step; 0 for floats.
double length_of_steps(model::ComponentType type, unsigned components);

}  // namespace gltfx::validate

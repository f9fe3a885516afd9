// SPDX-License-Identifier: Apache-2.0
/// What values attributes may have that extensions bring.
#pragma once

#include <optional>
#include <string_view>

#include "model/accessor.hpp"
#include "model/animation.hpp"
#include "model/object_model.hpp"
#include "validate/data/check.hpp"

namespace gltfx::validate {

/// The check of a vertex attribute by its whole name; nothing where any finite value may stand.
std::optional<CheckKind> vertex_value_check(std::string_view name);

/// The check of an attribute of instances.
std::optional<CheckKind> instance_value_check(std::string_view name, const model::Format& format);

/// The check of what a channel writes into a property that it names by a pointer: a rotation, or
/// numbers with limits. Nothing for other properties and other channels. `model` is that of the
/// asset; the place is left to the caller.
std::optional<Check> pointer_value_check(const Context& context, model::ObjectModel& model,
                                         const model::AnimationChannel& channel);

/// How far from 1 a unit vector of `components` numbers of that type may be when each of them is
/// off by one step; 0 for floats.
double length_of_steps(model::ComponentType type, unsigned components);

}  // namespace gltfx::validate

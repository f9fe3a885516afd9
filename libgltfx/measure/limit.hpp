// SPDX-License-Identifier: Apache-2.0
/// Limits as a user writes them, and lists of them that replace one another.
#pragma once

#include <gltfx/limit.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/result.hpp"

namespace gltfx::measure {

// Each Error here is a clause without a full stop.

/// The scope of that name. The Error has the nearest one.
Result<MeasureScope> scope_of(std::string_view name);
/// The measure of that name on the scope. The Error has the nearest one, or the scopes that it is
/// on.
Result<const MeasureDescription*> measure_of(MeasureScope on, std::string_view name);
/// The operators that a measure has on a scope.
std::vector<std::string_view> ops_of(const MeasureDescription& measure, MeasureScope on);
/// The operator of that name, which the measure must have. The Error has those that it has.
Result<LimitOp> op_of(const MeasureDescription& measure, MeasureScope on, std::string_view name);

/// A value as it is written.
using Literal = std::variant<bool, double, std::string, std::vector<std::string>>;

/// Takes the value of a limit, whose other members are set: `op` is an operator of its measure.
/// Patterns are compiled.
std::optional<Error> set_value(Limit& limit, const Literal& value);
/// The operator that a value without one means: for a number `max`, for `true` `equal`.
Result<LimitOp> op_of(const MeasureDescription& measure, const Literal& value);

/// A parameter of measures: "weld", "angle", "at", "slot". False: there is none of that name.
bool is_parameter(std::string_view name);
/// Whether the measure depends on it.
bool has_parameter(const MeasureDescription& measure, std::string_view name);
std::optional<Error> set_parameter(MeasureParameters& parameters, std::string_view name,
                                   const Literal& value);
/// Those that are not the default: "weld 0.001 m, angle 30 deg". Sizes of products are left out.
std::string parameter_words(const MeasureParameters& parameters);

/// Limits of one place for one measure: they replace those of earlier places.
struct LimitChange {
  const MeasureDescription* measure = nullptr;
  MeasureScope on = MeasureScope::asset;
  std::optional<LimitOp> op;  ///< those of this operator only; nothing: of all
  std::vector<Limit> limits;  ///< empty: the limit is lifted
};

/// Changes a list, which is sorted by scope, measure and operator.
void apply(std::vector<Limit>& limits, const LimitChange& change);

/// "mesh.vertices=65535", "size-z=0.2..4", "gpu-bytes=64 MiB", "mesh.closed=true",
/// "name.match=^[a-z]", "extensions.allow=KHR_a,KHR_b", "triangles=false". `from` is that of the
/// limits.
Result<std::vector<LimitChange>> read_budget(std::string_view text, std::string_view from);

/// The value of a limit: "65,535", "67,108,864 bytes", "true", "^[a-z]".
std::string value_words(const Limit& limit);

}  // namespace gltfx::measure

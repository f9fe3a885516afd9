// SPDX-License-Identifier: Apache-2.0
/// The results of the shader for the cases of each category.
#pragma once

#include <gltfx/material.hpp>

#include "value.hpp"

namespace gltfx::ground_truth {

/// Values for the keys of `expected`; null for an unknown key.
using Category = Value (*)(Inputs& inputs, const Value& expected);

/// Null for an unknown category.
Category find_category(std::string_view name);

Value evaluate_bsdf(Inputs& inputs, const Value& expected);
Value directional_albedo(Inputs& inputs, const Value& expected);
Value backlit_plane(Inputs& inputs, const Value& expected);
Value symmetric_lights(Inputs& inputs, const Value& expected);

Value white_furnace(Inputs& inputs, const Value& expected);
Value model_property(Inputs& inputs, const Value& expected);
Value multi_bounce(Inputs& inputs, const Value& expected);

Value volume_slab(Inputs& inputs, const Value& expected);
Value volume_sphere(Inputs& inputs, const Value& expected);
Value beer_lambert(Inputs& inputs, const Value& expected);

Value sss_semi_infinite(Inputs& inputs, const Value& expected);
Value sss_slab(Inputs& inputs, const Value& expected);
Value sss_sphere(Inputs& inputs, const Value& expected);
Value sss_parameters(Inputs& inputs, const Value& expected);
Value scatter_parameters(Inputs& inputs, const Value& expected);
Value phase_function(Inputs& inputs, const Value& expected);

Value iridescence(Inputs& inputs, const Value& expected);
Value dispersion(Inputs& inputs, const Value& expected);
Value sheen(Inputs& inputs, const Value& expected);

Value texture_transform(Inputs& inputs, const Value& expected);
Value punctual(Inputs& inputs, const Value& expected);
Value output(Inputs& inputs, const Value& expected);

Value identity(Inputs& inputs, const Value& expected);

/// The material of a case. Names are those of the file; what is missing has the default of its
/// specification, but metallic 0.
Material read_properties(Inputs& inputs);
/// The same of `inputs.material`.
Material read_material(Inputs& inputs);

/// Unit vector of (theta, phi) in degrees.
Vec3d direction(const std::vector<double>& angles);
/// Unit vector with that cosine to +z.
Vec3d direction_of_cosine(double cosine);

inline constexpr ShaderOptions kSpec{ShaderMode::spec, -1};

}  // namespace gltfx::ground_truth

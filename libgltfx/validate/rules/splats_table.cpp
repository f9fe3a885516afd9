// SPDX-License-Identifier: Apache-2.0
// Examples of an extension name it, as those of any extension do.
#include "validate/rules/splats_table.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_gaussian_splatting"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0,
  "KHR_gaussian_splatting:ROTATION": 1,
  "KHR_gaussian_splatting:SCALE": 2,
  "KHR_gaussian_splatting:OPACITY": 3,
  "KHR_gaussian_splatting:SH_DEGREE_0_COEF_0": 4},
  "extensions": {"KHR_gaussian_splatting": {"kernel": "ellipse", "colorSpace": "srgb_rec709_display"}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "SCALAR", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})";

constexpr RuleDescription kRules[] = {
    {"SPLAT_ATTRIBUTE_MISSING", Severity::error, "A primitive of splats lacks an attribute",
     "A splat is a place, a rotation, a size, an opacity and a colour; without one of them it "
     "cannot be drawn.",
     "Add the attribute.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_gaussian_splatting"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0,
  "KHR_gaussian_splatting:ROTATION": 1,
  "KHR_gaussian_splatting:SCALE": 2,
  "KHR_gaussian_splatting:SH_DEGREE_0_COEF_0": 3},
  "extensions": {"KHR_gaussian_splatting": {"kernel": "ellipse", "colorSpace": "srgb_rec709_display"}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})",
     kGood, Fix::none, false},
    {"SPLAT_HARMONICS_INCOMPLETE", Severity::error,
     "Coefficients of spherical harmonics are missing",
     "Each degree needs all of its coefficients and all degrees below it; a program that finds "
     "gaps drops the colour or the splats.",
     "Add the missing coefficients, or remove the degrees above the gap.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_gaussian_splatting"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0,
  "KHR_gaussian_splatting:ROTATION": 1,
  "KHR_gaussian_splatting:SCALE": 2,
  "KHR_gaussian_splatting:OPACITY": 3,
  "KHR_gaussian_splatting:SH_DEGREE_0_COEF_0": 4,
  "KHR_gaussian_splatting:SH_DEGREE_1_COEF_0": 5},
  "extensions": {"KHR_gaussian_splatting": {"kernel": "ellipse", "colorSpace": "srgb_rec709_display"}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "SCALAR", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_gaussian_splatting"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0,
  "KHR_gaussian_splatting:ROTATION": 1,
  "KHR_gaussian_splatting:SCALE": 2,
  "KHR_gaussian_splatting:OPACITY": 3,
  "KHR_gaussian_splatting:SH_DEGREE_0_COEF_0": 4,
  "KHR_gaussian_splatting:SH_DEGREE_1_COEF_0": 5,
  "KHR_gaussian_splatting:SH_DEGREE_1_COEF_1": 6,
  "KHR_gaussian_splatting:SH_DEGREE_1_COEF_2": 7},
  "extensions": {"KHR_gaussian_splatting": {"kernel": "ellipse", "colorSpace": "srgb_rec709_display"}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "SCALAR", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})",
     Fix::none, false},
    {"SPLAT_INVALID_MODE", Severity::error, "Splats are not points",
     "Each vertex is one splat; lines and triangles have no meaning for them.",
     "Set the mode of the primitive to POINTS (0).",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_gaussian_splatting"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0,
  "KHR_gaussian_splatting:ROTATION": 1,
  "KHR_gaussian_splatting:SCALE": 2,
  "KHR_gaussian_splatting:OPACITY": 3,
  "KHR_gaussian_splatting:SH_DEGREE_0_COEF_0": 4},
  "extensions": {"KHR_gaussian_splatting": {"kernel": "ellipse", "colorSpace": "srgb_rec709_display"}}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3},
  {"componentType": 5126, "type": "SCALAR", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})",
     kGood, Fix::none, false},
};

}  // namespace

std::span<const RuleDescription> splats_rules() { return kRules; }

}  // namespace gltfx::validate

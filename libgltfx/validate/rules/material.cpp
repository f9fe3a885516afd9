// SPDX-License-Identifier: Apache-2.0
// Core properties of materials that only make sense together.
#include <fmt/format.h>

#include "base/text.hpp"
#include "model/fields.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr RuleDescription kRules[] = {
    {"MATERIAL_ALPHA_CUTOFF_INVALID_MODE", Severity::warning,
     "A material has an alpha cutoff, but is not masked",
     "The cutoff is compared with alpha only when alphaMode is MASK. Without it the surface stays "
     "opaque or is blended.",
     "Set alphaMode to MASK, or remove alphaCutoff.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"alphaCutoff": 0.3}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"alphaCutoff": 0.3, "alphaMode": "MASK"}]})",
     Fix::none, true},
};

bool is_known_mode(const std::string& mode) {
  return mode == "OPAQUE" || mode == "BLEND" || mode.empty();
}

void check_alpha_cutoff(const Context& context, json::NodeId material, const Path& path) {
  const json::Document& document = context.document;
  const json::NodeId cutoff = document.find(material, "alphaCutoff");
  const bool given = cutoff != json::kNoNode && document.is_number(cutoff);
  if (!given && !(context.khronos() && document.holds(material, "alphaCutoff"))) return;
  const std::string mode = model::string_member(document, material, "alphaMode");
  if (mode == "MASK") return;
  // A wrong mode or a wrong cutoff has been reported; which of the two was meant is not known.
  const auto sound = [&] { return is_known_mode(mode) && document.number(cutoff).value >= 0; };
  if (!context.khronos() && !sound()) return;
  report_member(context.schema_sink, context, path, material, "alphaCutoff",
                "MATERIAL_ALPHA_CUTOFF_INVALID_MODE",
                fmt::format("alphaCutoff has no effect while alphaMode is {}.",
                            mode.empty() ? "'OPAQUE' (the default)" : gltfx::quoted(mode)));
}

constexpr ObjectRuleEntry kObjectRules[] = {{"material", check_alpha_cutoff, "alphaCutoff"}};

}  // namespace

const Family& material_family() {
  static const Family family{"material", kRules, kObjectRules, {}};
  return family;
}

}  // namespace gltfx::validate

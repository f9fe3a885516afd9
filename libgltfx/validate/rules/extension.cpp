// SPDX-License-Identifier: Apache-2.0
// What the schema walk says of extensions: declared, at home, in good company.
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kMinimal = R"({"asset": {"version": "2.0"}})";

constexpr RuleDescription kRules[] = {
    {"EXTENSION_COMPANION_MISSING", Severity::warning,
     "An extension stands without one it builds on", "Alone it has no effect, or no defined one.",
     "Add the other extension to the same object, or remove this one.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ADOBE_materials_clearcoat_tint"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"extensions": {"ADOBE_materials_clearcoat_tint": {}}}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ADOBE_materials_clearcoat_tint", "KHR_materials_clearcoat"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"extensions": {"ADOBE_materials_clearcoat_tint": {}, "KHR_materials_clearcoat": {"clearcoatFactor": 1}}}]})",
     Fix::none, false},
    {"EXTENSION_EXCLUDED", Severity::error, "Two extensions on one object exclude each other",
     "Each describes the surface in a way that leaves no room for the other; what is drawn "
     "depends on the program.",
     "Remove one of the two.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit", "KHR_materials_clearcoat"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"extensions": {"KHR_materials_unlit": {}, "KHR_materials_clearcoat": {"clearcoatFactor": 1}}}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_clearcoat"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}}]})",
     Fix::none, false},
    {"EXTENSION_OVERRIDDEN", Severity::warning, "An extension is overridden by another one",
     "What it says cannot be seen while the other is in force.",
     "Remove the extension without effect, or lower the other.", kMinimal, kMinimal, Fix::none,
     false},
    {"INVALID_EXTENSION_NAME_FORMAT", Severity::warning,
     "The name of an extension has no registered form",
     "Names begin with a vendor prefix in capitals and an underscore, so that two vendors "
     "never choose the same.",
     "Rename the extension to PREFIX_name.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["sparkle"]})", kMinimal, Fix::none, true},
    {"MULTIPLE_EXTENSIONS", Severity::warning,
     "An extension that replaces the whole object stands beside others",
     "It takes the place of the standard material; others may be ignored beside it.",
     "Keep the extension alone, or remove it.", kMinimal, kMinimal, Fix::none, true},
    {"NON_REQUIRED_EXTENSION", Severity::error,
     "An extension that cannot be optional is not listed as required",
     "The asset cannot be read without it, and programs that do not know it are not warned.",
     "List the extension in extensionsRequired.", kMinimal, kMinimal, Fix::none, true},
    {"UNDECLARED_EXTENSION", Severity::error, "An extension is used but not declared",
     "Programs look into extensionsUsed to know what to load; the object is skipped.",
     "Add the name to extensionsUsed.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"extensions": {"KHR_materials_unlit": {}}}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit"],
"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "materials": [{"extensions": {"KHR_materials_unlit": {}}}]})",
     Fix::none, true},
    {"UNEXPECTED_EXTENSION_OBJECT", Severity::error,
     "An extension stands on an object where it means nothing",
     "Readers look for it elsewhere, so it has no effect.", "Move it to the object it is made for.",
     R"({"asset": {"version": "2.0", "extensions": {"KHR_materials_unlit": {}}}, "extensionsUsed": ["KHR_materials_unlit"]})",
     kMinimal, Fix::none, true},
    {"UNUSED_EXTENSION_REQUIRED", Severity::error,
     "An extension is required but not declared as used",
     "Every required extension is a used one; programs read the two lists together.",
     "Add the name to extensionsUsed, or remove it from extensionsRequired.", kMinimal, kMinimal,
     Fix::none, true},
};

}  // namespace

const Family& extension_family() {
  static const Family family{"extension", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// The table of what is found in files with measured light.
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

constexpr RuleDescription kRules[] = {
    {"IES_PROFILE_INVALID", Severity::error, "A light profile is none that readers must know",
     "The light has no distribution, and shines in all directions or not at all.",
     "Export the profile as LM-63 of 1995, 2002 or 2019.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_lights_ies"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"extensions": {"EXT_lights_ies": {"light": 0}}}],
 "extensions": {"EXT_lights_ies": {"lights": [{"uri": "data:application/x-ies-lm-63;base64,SUVTTkE5MQpUSUxUPU5PTkUKMSAxMDAgMSAyIDEgMSAyIDAgMCAwCjEgMSAwCjAgOTAKMAoxMCA1Cg=="}]}}})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_lights_ies"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"extensions": {"EXT_lights_ies": {"light": 0}}}],
 "extensions": {"EXT_lights_ies": {"lights": [{"uri": "data:application/x-ies-lm-63;base64,SUVTTkE6TE0tNjMtMjAwMgpUSUxUPU5PTkUKMSAxMDAgMSAyIDEgMSAyIDAgMCAwCjEgMSAwCjAgOTAKMAoxMCA1Cg=="}]}}})",
     Fix::none, false},
};

}  // namespace

const Family& light_profile_family() {
  static const Family family{"light_profile", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate

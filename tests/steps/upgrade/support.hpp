// SPDX-License-Identifier: Apache-2.0
/// Documents with legacy materials, planned and changed.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "json/parse.hpp"
#include "schema/compile.hpp"
#include "steps/upgrade/plan.hpp"

namespace gltfx::upgrade::test {

using Json = nlohmann::ordered_json;

inline constexpr std::string_view kOld = "KHR_materials_translucency";
inline constexpr std::string_view kNew = "KHR_materials_diffuse_transmission";

struct Upgraded {
  Plan plan;
  std::string text;
  Json json() const { return Json::parse(text); }
  const UpgradeAction& only() const { return plan.actions.at(0); }
};

inline Upgraded upgraded(const std::string& text, const UpgradeOptions& options = {},
                         Pictures* pictures = nullptr) {
  const json::Parsed parsed = json::parse(std::string_view(text));
  EXPECT_TRUE(parsed.ok()) << text;
  Upgraded result;
  result.plan = make_plan(parsed.document, *schema::builtin_set(), options, pictures);
  result.text = json::apply_edits(text, result.plan.change.edits);
  return result;
}

/// A run with only these legacy extensions.
inline UpgradeOptions only(std::vector<std::string> names) {
  UpgradeOptions options;
  options.only = std::move(names);
  return options;
}

/// A document with one material: `material` are its members before its extensions, `legacy` the
/// members of the legacy extension, `root` further members of the root.
inline std::string document_with(const std::string& material, const std::string& legacy,
                                 const std::string& root = "") {
  std::string text =
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_translucency"],)";
  text.append(R"("textures":[{},{}],)").append(root).append(R"("materials":[{)").append(material);
  text.append(R"("extensions":{"KHR_materials_translucency":{)").append(legacy).append("}}}]}");
  return text;
}

/// Members of the root: an animation with the target of a JSON pointer.
inline std::string animated(const std::string& pointer) {
  return R"("animations":[{"channels":[{"target":{"path":"pointer","extensions":)"
         R"({"KHR_animation_pointer":{"pointer":")" +
         pointer + R"("}}}}]}],)";
}

inline std::string pointer_of(const Json& root) {
  return root["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]
             ["pointer"];
}

inline Json extension_of(const Upgraded& result) {
  return result.json()["materials"][0]["extensions"][std::string(kNew)];
}

}  // namespace gltfx::upgrade::test

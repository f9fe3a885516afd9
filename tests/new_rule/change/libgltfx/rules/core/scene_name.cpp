// SPDX-License-Identifier: Apache-2.0
#include "base/codes.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

void check_name(const Context& context, json::NodeId scene, const Path& path) {
  if (context.document.find(scene, "name") != json::kNoNode) return;
  context.schema_sink.report(
      path, finding_on(context, scene, Code::ZZ_SCENE_UNNAMED, "The scene has no name."));
}

constexpr ObjectRuleEntry kObjectRules[] = {{"scene", check_name}};

}  // namespace

const RuleGroup& scene_name_rules() {
  static constexpr RuleGroup group{.object_rules = kObjectRules};
  return group;
}

}  // namespace gltfx::validate

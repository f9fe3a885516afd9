// SPDX-License-Identifier: Apache-2.0
// KHR_lights_punctual: the members of each kind of light. This file is about that one extension and
// names it.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

// An angle of a cone, `otherwise` if it is absent, nothing if it is invalid (and reported).
std::optional<double> angle(const json::Document& document, json::NodeId spot,
                            std::string_view member, double otherwise) {
  if (!document.has_value(spot, member)) return otherwise;
  constexpr double kHalfPi = 1.5707963267948966;
  const auto value = model::number_member(document, spot, member);
  return value && *value >= 0 && *value <= kHalfPi ? value : std::nullopt;
}

void check_cone(const Context& context, json::NodeId spot, const Path& path) {
  constexpr double kQuarterPi = 0.7853981633974483;
  const auto inner = angle(context.document, spot, "innerConeAngle", 0);
  const auto outer = angle(context.document, spot, "outerConeAngle", kQuarterPi);
  if (!inner || !outer || *outer > *inner) return;
  const bool given = context.document.find(spot, "outerConeAngle") != json::kNoNode;
  report_member(context.schema_sink, context, path, spot, "outerConeAngle",
                Code::KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES,
                fmt::format("outerConeAngle is {}{}; it must be greater than innerConeAngle, {}.",
                            number_text(*outer), given ? "" : " by default", number_text(*inner)));
}

void report_extra(const Context& context, json::NodeId light, const Path& path,
                  std::string_view member, const std::string& type) {
  if (!context.document.holds(light, member)) return;
  report_member(context.schema_sink, context, path, light, member, Code::EXTRA_PROPERTY,
                fmt::format("{} has no effect on a light of type {}.", gltfx::quoted(member),
                            gltfx::quoted(type)));
}

void check_light(const Context& context, json::NodeId light, const Path& path) {
  const std::string type = model::string_member(context.document, light, "type");
  if (type == "spot") {
    const json::NodeId spot = model::object_member(context.document, light, "spot");
    if (spot != json::kNoNode) check_cone(context, spot, Path(path, "spot"));
  } else if (type == "point" || type == "directional" ||
             context.deviations.consequences_are_reported) {
    report_extra(context, light, path, "spot", type);
  }
}

void check_range(const Context& context, json::NodeId light, const Path& path) {
  const std::string type = model::string_member(context.document, light, "type");
  const bool ranged = context.document.find(light, "range") != json::kNoNode;
  if (type == "directional" && ranged) report_extra(context, light, path, "range", type);
}

schema::Reading read_spot(const Context& context, json::NodeId light, json::NodeId, const Path&) {
  const bool spot = model::string_member(context.document, light, "type") == "spot";
  return spot ? schema::Reading::check : schema::Reading::keep;
}

// Reports lights on nodes of an asset without lights. Otherwise the index is reported.
void check_lights_exist(const Context& context) {
  constexpr std::string_view kLightsPunctualExtension = "KHR_lights_punctual";
  if (!context.deviations.root_extension_is_a_dependency) return;
  if (!ActiveExtensions(context).contains(kLightsPunctualExtension)) return;
  const Path root;
  const Path array(root, "nodes");
  const auto& nodes = context.asset.elements(model::RootArray::nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const json::NodeId light =
        model::extension_object(context.document, nodes[i], kLightsPunctualExtension);
    if (light == json::kNoNode) continue;
    const Path node(array, static_cast<std::uint64_t>(i));
    const Path extensions(node, "extensions");
    if (check_root_extension(context, kLightsPunctualExtension, light,
                             Path(extensions, kLightsPunctualExtension)))
      report_references(context, light);
  }
}

}  // namespace

const RuleGroup& lights_punctual_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"KHR_lights_punctual.light", check_light, "spot"},
      {"KHR_lights_punctual.light", check_range, "range"}};
  static constexpr MemberRuleEntry kMemberRules[] = {
      {"KHR_lights_punctual.light", "spot", read_spot}};
  static constexpr LinkRule kLinkRules[] = {check_lights_exist};
  static constexpr FixEntry kFixes[] = {{Code::EXTRA_PROPERTY, remove_marked}};
  static constexpr RuleGroup group{.object_rules = kObjectRules,
                                   .link_rules = kLinkRules,
                                   .member_rules = kMemberRules,
                                   .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate

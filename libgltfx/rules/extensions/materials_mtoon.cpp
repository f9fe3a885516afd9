// SPDX-License-Identifier: Apache-2.0
// VRMC_materials_mtoon: members that depend on the alpha mode of the material with the extension.
#include <array>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kToon = "VRMC_materials_mtoon";

void check_toon_material(const Context& context, const ExtensionPlace& place, const Path& path) {
  const json::Document& document = context.document;
  const bool blended = model::string_member(document, place.host, "alphaMode") == "BLEND";
  const bool depth = model::true_member(document, place.object, "transparentWithZWrite");
  if (depth && !blended) {
    report_member(context.link_sink, context, path, place.object, "transparentWithZWrite",
                  Code::TOON_DEPTH_WITHOUT_BLEND,
                  "transparentWithZWrite has no effect without the alpha mode BLEND.");
  }
  const double offset =
      model::number_member(document, place.object, "renderQueueOffsetNumber").value_or(0);
  const double least = blended && !depth ? -9 : 0;
  const double most = blended && depth ? 9 : 0;
  if (offset >= least && offset <= most) return;
  report_member(
      context.link_sink, context, path, place.object, "renderQueueOffsetNumber",
      Code::TOON_RENDER_QUEUE,
      fmt::format("renderQueueOffsetNumber is {}; it must be {} for {}.", number_text(offset),
                  least == most ? std::string("0") : fmt::format("between {} and {}", least, most),
                  !blended ? "a material that is not blended"
                  : depth  ? "a blended material that writes depth"
                           : "a blended material"));
}

// A member that describes an outline although there is none; empty: there is one, or no member
// describes it.
std::string_view idle_outline(const json::Document& document, json::NodeId object) {
  const std::string mode = model::string_member(document, object, "outlineWidthMode");
  if (!mode.empty() && mode != "none") return {};
  if (model::number_member(document, object, "outlineWidthFactor").value_or(0) > 0) {
    return "outlineWidthFactor";
  }
  if (document.find(object, "outlineWidthMultiplyTexture") != json::kNoNode) {
    return "outlineWidthMultiplyTexture";
  }
  const json::NodeId color = document.find(object, "outlineColorFactor");
  const auto parts = model::float_array<3>(document, color);
  if (parts && *parts != std::array<float, 3>{0, 0, 0}) return "outlineColorFactor";
  if (model::number_member(document, object, "outlineLightingMixFactor").value_or(1) != 1) {
    return "outlineLightingMixFactor";
  }
  return {};
}

// Programs write the members of all materials alike, so only one is reported.
void check_outlines_shown(const Context& context) {
  std::size_t count = 0;
  for_each_extension(context, model::RootArray::materials, kToon,
                     [&](const ExtensionPlace& place, const Path&) {
                       count += idle_outline(context.document, place.object).empty() ? 0U : 1U;
                     });
  bool reported = count == 0;
  for_each_extension(context, model::RootArray::materials, kToon,
                     [&](const ExtensionPlace& place, const Path& path) {
                       const std::string_view member = idle_outline(context.document, place.object);
                       if (reported || member.empty()) return;
                       reported = true;
                       std::string message = fmt::format(
                           "{} has no effect, because outlineWidthMode is none.", member);
                       if (count > 1)
                         message += fmt::format(" It is the first of {} such materials.", count);
                       report_member(context.link_sink, context, path, place.object, member,
                                     Code::TOON_OUTLINE_OFF, std::move(message));
                     });
}

void check_toon(const Context& context) {
  for_each_extension(context, model::RootArray::materials, kToon,
                     [&](const ExtensionPlace& place, const Path& path) {
                       check_toon_material(context, place, path);
                     });
  check_outlines_shown(context);
}

}  // namespace

const RuleGroup& materials_mtoon_rules() {
  static constexpr LinkRule kLinkRules[] = {check_toon};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

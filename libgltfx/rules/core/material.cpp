// SPDX-License-Identifier: Apache-2.0
// Core properties of materials that are only valid together.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

bool is_known_mode(const std::string& mode) {
  return mode == "OPAQUE" || mode == "BLEND" || mode.empty();
}

void check_alpha_cutoff(const Context& context, json::NodeId material, const Path& path) {
  const json::Document& document = context.document;
  const json::NodeId cutoff = document.find(material, "alphaCutoff");
  const bool given = cutoff != json::kNoNode && document.is_number(cutoff);
  const bool broken = !given && document.holds(material, "alphaCutoff");
  const bool consequences = context.deviations.consequences_are_reported;
  if (!given && !(broken && consequences)) return;
  const std::string mode = model::string_member(document, material, "alphaMode");
  if (mode == "MASK") return;
  // A wrong mode or cutoff is reported; it is unclear which of the two was meant.
  const auto sound = [&] { return is_known_mode(mode) && document.number(cutoff).value >= 0; };
  if (!consequences && !sound()) return;
  // Readers ignore it with another mode; without a mode it is not allowed.
  report_member(context.schema_sink, context, path, material, "alphaCutoff",
                Code::MATERIAL_ALPHA_CUTOFF_INVALID_MODE,
                fmt::format("alphaCutoff has no effect because alphaMode is {}.",
                            mode.empty() ? "'OPAQUE' (the default)" : gltfx::quoted(mode)),
                {}, mode.empty() ? Severity::error : Severity::warning);
}

constexpr FixEntry kMaterialFixes[] = {{Code::MATERIAL_ALPHA_CUTOFF_INVALID_MODE, remove_marked}};

}  // namespace

const RuleGroup& material_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"material", check_alpha_cutoff, "alphaCutoff"}};
  static constexpr RuleGroup group{.object_rules = kObjectRules, .fixes = kMaterialFixes};
  return group;
}

}  // namespace gltfx::validate

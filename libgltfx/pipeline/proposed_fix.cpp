// SPDX-License-Identifier: Apache-2.0
#include "pipeline/proposed_fix.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "json/lines.hpp"
#include "json/parse.hpp"
#include "pipeline/new_findings.hpp"
#include "schema/compile.hpp"
#include "upgrade/plan.hpp"

namespace gltfx {
namespace {

bool asks_for_upgrade(const Diagnostic& finding) {
  return finding.code == "EXTENSION_LEGACY" || finding.code == "EXTENSION_ARCHIVED";
}

// The place of the first finding that names an extension of which the plan upgrades something.
std::optional<std::size_t> first_mended(const FileReport& report, const json::Document& document,
                                        const upgrade::Plan& plan) {
  for (std::size_t i = 0; i < report.diagnostics.size(); ++i) {
    const Diagnostic& finding = report.diagnostics[i];
    if (!asks_for_upgrade(finding)) continue;
    const json::NodeId entry = document.resolve(finding.pointer);
    if (entry == json::kNoNode || !document.is_string(entry)) continue;
    const std::string name = document.string(entry);
    for (const UpgradeAction& action : plan.actions) {
      if (action.done && action.from == name) return i;
    }
  }
  return std::nullopt;
}

std::string description_of(const upgrade::Plan& plan) {
  std::uint64_t done = 0;
  for (const UpgradeAction& action : plan.actions) done += action.done ? 1U : 0U;
  return fmt::format(
      "Bring {} of {} legacy object{} to the successor, with the same picture, as 'gltfx upgrade' "
      "does.",
      done, plan.actions.size(), plan.actions.size() == 1 ? "" : "s");
}

ProposedFix fix_of(const upgrade::Plan& plan, std::string_view text) {
  ProposedFix fix;
  fix.description = description_of(plan);
  const json::LineIndex lines(text);
  for (const json::Edit& edit : plan.edits) {
    fix.replacements.push_back({lines.locate(edit.span), edit.text});
  }
  return fix;
}

bool is_sound(const container::Container& container, const json::Parsed& parsed) {
  return parsed.ok() && container.errors.empty() && container.late_errors.empty() &&
         container.format == container::Format::gltf;
}

}  // namespace

void propose_fix(validate::ValidatedAsset& validated, const ValidateOptions& options) {
  const model::OpenedAsset& asset = validated.asset();
  const auto& findings = validated.report().diagnostics;
  const bool asked = std::any_of(findings.begin(), findings.end(), asks_for_upgrade);
  if (!asked || asset.document().empty()) return;
  if (!is_sound(asset.container(), asset.parsed())) return;
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  const upgrade::Plan plan = upgrade::make_plan(asset.document(), *schemas, {});
  const auto finding = first_mended(validated.report(), asset.document(), plan);
  if (!finding || plan.edits.empty()) return;
  const std::string_view text = *asset.container().json;
  container::Container fixed = container::open_bytes(
      container::Bytes::from_string(json::apply_edits(text, plan.edits)), asset.name());
  const validate::ValidatedAsset after({asset.name(), std::move(fixed), asset.resolver()},
                                       default_judgement(schemas));
  if (!new_findings(validated, after, schemas).error.empty()) return;
  validated.propose(*finding, std::make_shared<const ProposedFix>(fix_of(plan, text)));
}

}  // namespace gltfx

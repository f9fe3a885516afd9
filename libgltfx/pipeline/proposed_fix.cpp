// SPDX-License-Identifier: Apache-2.0
#include "pipeline/proposed_fix.hpp"

#include <memory>
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

// The first finding that names an extension of which the plan upgrades something.
Diagnostic* first_mended(FileReport& report, const json::Document& document,
                         const upgrade::Plan& plan) {
  for (Diagnostic& finding : report.diagnostics) {
    if (!asks_for_upgrade(finding)) continue;
    const json::NodeId entry = document.resolve(finding.pointer);
    if (entry == json::kNoNode || !document.is_string(entry)) continue;
    const std::string name = document.string(entry);
    for (const UpgradeAction& action : plan.actions) {
      if (action.done && action.from == name) return &finding;
    }
  }
  return nullptr;
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
  return parsed.ok() && container.faults.empty() && container.late_faults.empty() &&
         container.format == container::Format::gltf;
}

}  // namespace

void propose_fix(FileReport& report, const container::Container& container,
                 const container::Resolver& resolver, const ValidateOptions& options) {
  bool asked = false;
  for (const Diagnostic& finding : report.diagnostics) asked |= asks_for_upgrade(finding);
  if (!asked || !container.json) return;
  const json::Parsed parsed = json::parse(container.json);
  if (parsed.document.empty() || !is_sound(container, parsed)) return;
  const auto schemas = options.schemas ? options.schemas : schema::builtin_set();
  const upgrade::Plan plan = upgrade::make_plan(parsed.document, *schemas, {});
  Diagnostic* finding = first_mended(report, parsed.document, plan);
  if (finding == nullptr || plan.edits.empty()) return;
  const container::Container mended = container::open_bytes(
      container::Bytes::from_string(json::apply_edits(*container.json, plan.edits)), report.path);
  const NewFindings fresh =
      new_findings({container, resolver}, {mended, resolver}, report.path, schemas);
  if (!fresh.error.empty()) return;
  finding->fix = std::make_shared<const ProposedFix>(fix_of(plan, *container.json));
}

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fixable.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/code.hpp"
#include "change/apply.hpp"
#include "change/rewrite.hpp"
#include "json/lines.hpp"
#include "pipeline/fix_plan.hpp"
#include "prove/findings.hpp"
#include "rules/context.hpp"
#include "rules/fix.hpp"
#include "schema/compile.hpp"

namespace gltfx {
namespace {

using validate::Sites;
using validate::ValidatedAsset;

constexpr std::size_t kMostNodes = 1U << 20U;       // of the JSON text
constexpr std::uint64_t kMostContent = 16U << 20U;  // bytes of buffers

// Sites for which a safe fix has a change, by position.
std::vector<bool> find_planned(const ValidatedAsset& validated, const schema::Set& schemas) {
  const model::OpenedAsset& asset = validated.asset();
  const Sites& sites = validated.sites();
  std::vector<bool> planned(sites.size());
  if (asset.document().node_count() > kMostNodes) return planned;
  if (!asset.container().json || change::find_glb_obstacle(asset.container())) return planned;
  std::map<validate::FixStage, validate::Fixing> stages;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (validate::description(sites[i].code).fix != Fix::safe) continue;
    const validate::FixStage stage = validate::find_fix(sites[i].code)->stage;
    validate::Fixing& fixing =
        stages.try_emplace(stage, asset, schemas, kMostContent).first->second;
    const bool has_change = fixing.fix(sites[i]);
    // Or the fix of another finding has changed the value already.
    planned[i] = fixing.take_was_claimed() || has_change;
  }
  return planned;
}

// A place of the text, or none, with a code.
using FindingPlace = std::pair<std::string_view, std::uint64_t>;

FindingPlace place_of(const Diagnostic& finding) {
  return {finding.code, finding.location.length == 0 ? UINT64_MAX : finding.location.offset};
}

FindingPlace place_of(const validate::Site& site, std::uint64_t json_offset) {
  return {code_name(site.code), site.span.end == 0 ? UINT64_MAX : json_offset + site.span.begin};
}

/// Fixes of one asset, a rule at a time.
class Proposals {
 public:
  Proposals(const ValidatedAsset& validated, const std::vector<bool>& planned,
            const ValidateOptions& asked)
      : validated_(validated),
        planned_(planned),
        schemas_(asked.schemas ? asked.schemas : schema::builtin_set()),
        validation_(fix_validation(schemas_, asked)) {}

  // What the fixes of one rule come to, where they are edits of the text alone.
  std::shared_ptr<const ProposedFix> propose(const RuleDescription& rule) {
    const model::OpenedAsset& asset = validated_.asset();
    const Sites& sites = validated_.sites();
    std::vector<bool> wanted = planned_;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      wanted[i] = wanted[i] && code_name(sites[i].code) == rule.code;
    }
    const auto planned = plan_fixes(asset, sites, *schemas_, wanted, kMostContent, {});
    if (planned.change.edits.empty()) return nullptr;
    if (planned.change.sound_chunks || !planned.change.replaced.empty()) return nullptr;
    auto changed = change::apply(asset, planned.change);
    if (!changed) return nullptr;
    const ValidatedAsset after(*std::move(changed), validation_);
    if (!prove::more_findings(before(), after.report()).empty()) return nullptr;
    return proposed_fix(std::string(rule.fix_does), asset, planned.change.edits);
  }

 private:
  const prove::CodeCounts& before() {
    if (!before_) {
      const model::OpenedAsset& asset = validated_.asset();
      const ValidatedAsset again({asset.name(), asset.container(), asset.resolver()}, validation_);
      before_.emplace(again.report());
    }
    return *before_;
  }

  const ValidatedAsset& validated_;
  const std::vector<bool>& planned_;
  std::shared_ptr<const schema::Set> schemas_;
  ValidateOptions validation_;
  std::optional<prove::CodeCounts> before_;
};

void propose(Proposals proposals, FileReport& report) {
  std::set<std::string_view> done;
  for (Diagnostic& finding : report.diagnostics) {
    if (!finding.fixable || finding.fix || !done.insert(finding.code).second) continue;
    finding.fix = proposals.propose(*find_rule(finding.code));
  }
}

}  // namespace

void mark_fixable(ValidatedAsset& validated, const ValidateOptions& asked) {
  const auto schemas = asked.schemas ? asked.schemas : schema::builtin_set();
  const Sites& sites = validated.sites();
  const container::Container& container = validated.asset().container();
  FileReport& report = validated.report();
  const std::vector<bool> planned = find_planned(validated, *schemas);
  std::set<FindingPlace> places;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    if (planned[i]) places.insert(place_of(sites[i], container.json_offset));
  }
  report.fixable = static_cast<std::uint64_t>(std::count(planned.begin(), planned.end(), true));
  for (Diagnostic& finding : report.diagnostics) {
    finding.fixable = places.contains(place_of(finding));
  }
  const bool is_text = container.format == container::Format::gltf;
  if (asked.propose_fixes && is_text) propose(Proposals(validated, planned, asked), report);
}

std::shared_ptr<const ProposedFix> proposed_fix(std::string description,
                                                const model::OpenedAsset& asset,
                                                const std::vector<json::Edit>& edits) {
  ProposedFix fix;
  fix.description = std::move(description);
  const json::LineIndex lines(*asset.container().json);
  for (const json::Edit& edit : edits) {
    fix.replacements.push_back({lines.locate(edit.span), edit.text});
  }
  return std::make_shared<const ProposedFix>(std::move(fix));
}

}  // namespace gltfx

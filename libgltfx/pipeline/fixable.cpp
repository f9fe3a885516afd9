// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fixable.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/codes.hpp"
#include "edit/rewrite.hpp"
#include "json/lines.hpp"
#include "pipeline/edit_asset.hpp"
#include "pipeline/fix_rounds.hpp"
#include "pipeline/open_asset.hpp"
#include "schema/compile.hpp"
#include "validate/context.hpp"

namespace gltfx {
namespace {

using model::OpenedAsset;
using validate::Site;
using validate::Sites;
using validate::ValidatedAsset;
using SchemaSet = std::shared_ptr<const schema::Set>;

// Whoever validates asked for no fix: what a run would do is found out at little cost, or not.
const FixEffort kEffort = {.trial_bytes = 4U << 20U, .content_bytes = 16U << 20U};
constexpr std::size_t kMostNodes = 1U << 20U;  // of the JSON text

bool is_safe(const Site& site) { return validate::description(site.code).fix == Fix::safe; }

// Whether a safe fix would change something, whatever became of it.
bool is_any_planned(const OpenedAsset& asset, const Sites& sites, const schema::Set& schemas) {
  if (!asset.container().json || edit::find_glb_obstacle(asset.container())) return false;
  if (std::none_of(sites.begin(), sites.end(), is_safe)) return false;
  validate::Fixing fixing(asset, schemas, kEffort.content_bytes);
  return std::any_of(sites.begin(), sites.end(), [&](const Site& site) {
    return is_safe(site) && validate::find_fix(site.code)->fix(fixing, site.span);
  });
}

/// What a run comes to.
struct FixRehearsal {
  std::vector<bool> removed;  ///< sites, by position
  FindingsByCode before;      ///< of the verb's own judgement
};

FixRehearsal rehearse(const ValidatedAsset& validated, const ValidateOptions& asked,
                      const SchemaSet& schemas) {
  const OpenedAsset& asset = validated.asset();
  const Sites& sites = validated.sites();
  FixRehearsal rehearsal{std::vector<bool>(sites.size()), {}};
  if (asset.document().node_count() > kMostNodes) return rehearsal;
  if (!is_any_planned(asset, sites, *schemas)) return rehearsal;
  OpenedAsset again(asset.name(), without_zero_padding(asset.container()), asset.resolver());
  ValidatedAsset before(std::move(again), fix_judgement(schemas, asked));
  rehearsal.before = findings_by_code(before.report());
  FixOptions options;
  options.validation = [&asked](const std::string&) { return asked; };
  const FixedAsset fixed = fix_in_rounds(std::move(before), options, schemas, kEffort);
  if (!fixed.changes || find_obstacle(fixed.after.asset())) return rehearsal;
  rehearsal.removed = sites_gone(sites, fixed.after.sites(), fixed.edits);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!is_safe(sites[i])) rehearsal.removed[i] = false;
  }
  return rehearsal;
}

// A place of the text, or none, with a code.
using FindingPlace = std::pair<std::string_view, std::uint64_t>;

FindingPlace place_of(const Diagnostic& finding) {
  return {finding.code, finding.location.length == 0 ? UINT64_MAX : finding.location.offset};
}

FindingPlace place_of(const Site& site, std::uint64_t json_offset) {
  return {code_name(site.code), site.span.end == 0 ? UINT64_MAX : json_offset + site.span.begin};
}

// What fixes of one rule come to, where they are edits of a text file and bring no new finding.
std::shared_ptr<const ProposedFix> proposal(const ValidatedAsset& validated,
                                            const FindingsByCode& before,
                                            const std::vector<bool>& wanted, std::string_view does,
                                            const ValidateOptions& asked,
                                            const SchemaSet& schemas) {
  const OpenedAsset& asset = validated.asset();
  const auto planned =
      plan_fixes(asset, validated.sites(), *schemas, wanted, kEffort.content_bytes, {});
  if (planned.changes.edits.empty()) return nullptr;
  if (planned.changes.container || !planned.changes.buffers.files.empty()) return nullptr;
  auto changed = with_changes(asset, planned.changes);
  if (!changed) return nullptr;
  const ValidatedAsset after(*std::move(changed), fix_judgement(schemas, asked));
  if (!worse_codes(before, after.report()).empty()) return nullptr;
  ProposedFix fix;
  fix.description = does;
  const json::LineIndex lines(*asset.container().json);
  for (const json::Edit& edit : planned.changes.edits) {
    fix.replacements.push_back({lines.locate(edit.span), edit.text});
  }
  return std::make_shared<const ProposedFix>(std::move(fix));
}

void propose(ValidatedAsset& validated, const FixRehearsal& rehearsal, const ValidateOptions& asked,
             const SchemaSet& schemas) {
  const Sites& sites = validated.sites();
  std::set<std::string_view> done;
  for (Diagnostic& finding : validated.report().diagnostics) {
    if (!finding.fixable || finding.fix || !done.insert(finding.code).second) continue;
    std::vector<bool> wanted = rehearsal.removed;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      wanted[i] = wanted[i] && code_name(sites[i].code) == finding.code;
    }
    finding.fix = proposal(validated, rehearsal.before, wanted, find_rule(finding.code)->fix_does,
                           asked, schemas);
  }
}

}  // namespace

void mark_fixable(ValidatedAsset& validated, const ValidateOptions& asked) {
  const SchemaSet schemas = asked.schemas ? asked.schemas : schema::builtin_set();
  const Sites& sites = validated.sites();
  const FixRehearsal rehearsal = rehearse(validated, asked, schemas);
  FileReport& report = validated.report();
  const container::Container& container = validated.asset().container();
  std::set<FindingPlace> places;
  for (std::size_t i = 0; i < rehearsal.removed.size(); ++i) {
    if (!rehearsal.removed[i]) continue;
    ++report.fixable;
    places.insert(place_of(sites[i], container.json_offset));
  }
  for (Diagnostic& finding : report.diagnostics) {
    finding.fixable = places.contains(place_of(finding));
  }
  const bool is_text = container.format == container::Format::gltf;
  if (asked.propose_fixes && is_text && report.fixable > 0) {
    propose(validated, rehearsal, asked, schemas);
  }
}

}  // namespace gltfx

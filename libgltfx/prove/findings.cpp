// SPDX-License-Identifier: Apache-2.0
#include "prove/findings.hpp"

#include <gltfx/validate.hpp>

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "rules/validator.hpp"

namespace gltfx::prove {
namespace {

bool is_serious(const Diagnostic& one) { return one.severity <= Severity::warning; }

/// Places of findings by code.
using Places = std::set<std::pair<std::string_view, std::string_view>>;

// The warning to show for a code: one at a new place, if possible.
std::string text_of(const MoreFindings& more, const FileReport& after, const Places& known) {
  const Diagnostic* shown = nullptr;
  for (const Diagnostic& one : after.diagnostics) {
    if (one.code != more.code || !is_serious(one)) continue;
    const bool is_new = !known.contains({one.code, one.pointer});
    if (shown == nullptr || is_new) shown = &one;
    if (is_new) break;
  }
  std::string text = fmt::format("{} at {}: {}", more.code, shown->pointer, shown->message);
  if (more.count > 1) text += fmt::format(" (and {} more)", more.count - 1);
  return text;
}

NewFindings compare(const FileReport& known, const FileReport& found, Louder louder) {
  Places places;
  for (const Diagnostic& one : known.diagnostics) {
    if (is_serious(one)) places.emplace(one.code, one.pointer);
  }
  NewFindings result;
  const CodeCounts before(known), after(found);
  for (const MoreFindings& more : more_findings(before, found, Severity::warning)) {
    const bool is_known = louder == Louder::is_known && after.of(more.code, Severity::warning) <=
                                                            before.of(more.code, Severity::warning);
    if (more.severity != Severity::error || is_known) {
      result.warnings.push_back(text_of(more, found, places));
    } else if (result.error.empty()) {
      result.error = more.code;
    }
  }
  return result;
}

FileReport validated_anew(const model::OpenedAsset& opened,
                          const std::shared_ptr<const schema::Set>& schemas) {
  model::OpenedAsset again(opened.name(), opened.container(), opened.resolver());
  return validate::validate(again, validate::default_validation(schemas));
}

// `use` takes the report of default options.
template <class Use>
NewFindings with_report(const model::OpenedAsset& opened,
                        const std::shared_ptr<const schema::Set>& schemas, const Use& use) {
  return use(validated_anew(opened, schemas));
}

template <class Use>
NewFindings with_report(const validate::ValidatedAsset& asset,
                        const std::shared_ptr<const schema::Set>& schemas, const Use& use) {
  return asset.validated_by_default() ? use(asset.report())
                                      : use(validated_anew(asset.asset(), schemas));
}

template <class Before>
NewFindings find_new(const Before& before, const validate::ValidatedAsset& after,
                     const std::shared_ptr<const schema::Set>& schemas, Louder louder) {
  return with_report(after, schemas, [&](const FileReport& found) {
    const auto& all = found.diagnostics;
    if (std::none_of(all.begin(), all.end(), is_serious)) return NewFindings();
    return with_report(before, schemas,
                       [&](const FileReport& known) { return compare(known, found, louder); });
  });
}

}  // namespace

CodeCounts::CodeCounts(const FileReport& report) {
  for (const Diagnostic& one : report.diagnostics) {
    Counts& counts = codes_[one.code];
    has_errors_ = has_errors_ || one.severity == Severity::error;
    for (auto i = static_cast<std::size_t>(one.severity); i < counts.size(); ++i) {
      counts[i] += one.count;
    }
  }
}

std::uint64_t CodeCounts::of(std::string_view code, Severity least) const {
  const auto found = codes_.find(code);
  return found == codes_.end() ? 0 : found->second[static_cast<std::size_t>(least)];
}

std::vector<MoreFindings> more_findings(const CodeCounts& before, const FileReport& after,
                                        Severity least) {
  std::vector<MoreFindings> worse;
  for (const auto& [code, now] : CodeCounts(after).codes_) {
    const auto known = before.codes_.find(code);
    const auto was = known == before.codes_.end() ? CodeCounts::Counts() : known->second;
    // What an asset shows is only looked at without errors.
    const RuleDescription* rule = find_rule(code);  // null: an own rule
    if (before.has_errors_ && rule != nullptr && !rule->group.empty()) continue;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(least); ++i) {
      if (now[i] <= was[i]) continue;
      worse.push_back({code, static_cast<Severity>(i), now[i] - was[i]});
      break;
    }
  }
  return worse;
}

NewFindings new_findings(const validate::ValidatedAsset& before,
                         const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas) {
  return find_new(before, after, schemas, Louder::is_new);
}

NewFindings new_findings(const model::OpenedAsset& before, const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas, Louder louder) {
  return find_new(before, after, schemas, louder);
}

}  // namespace gltfx::prove
